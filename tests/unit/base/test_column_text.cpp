// Text files of columns: delimiter, names, remarks, quotes, refusals.
#include <gtest/gtest.h>

#include "base/column_text.hpp"
#include "base/error.hpp"

namespace {

using namespace talus;

TEST(ColumnText, FindsDelimiterNamesAndLines) {
  const ColumnText text = parse_columns(
      "\xef\xbb\xbf"
      "# a remark\n\"East, m\";North (m);z\r\n\r\n1,5;2;3 # here\r\n4;5;6\r\n",
      "f");
  EXPECT_EQ(text.delimiter, ';');
  EXPECT_EQ(text.names, (std::vector<std::string>{"East, m", "North (m)", "z"}));
  EXPECT_EQ(text.line, (std::vector<int>{4, 5}));
  EXPECT_EQ(text.rows[0], (std::vector<std::string>{"1,5", "2", "3"}));
  EXPECT_EQ(find_column(text, {"x", "north"}), 1);
  EXPECT_EQ(find_column(text, {"x"}), -1);
  double value = 0;
  EXPECT_TRUE(parse_number(text, "1,5", value));
  EXPECT_EQ(value, 1.5);
  EXPECT_FALSE(parse_number(text, "1,5,2", value));
}

TEST(ColumnText, NamesMayStandBehindARemarkMark) {
  const ColumnText text = parse_columns("//X Y Z R\n1 2 3 4\n", "f");
  EXPECT_TRUE(text.names_in_remark);
  EXPECT_EQ(find_column(text, {"z"}), 2);
  EXPECT_TRUE(parse_columns("# of the ridge\n1 2\n", "f").names.empty());
}

TEST(ColumnText, NamesWithoutUnitsAndMarks) {
  EXPECT_EQ(plain_name("Dip dir. (deg)"), "dipdir");
  EXPECT_EQ(plain_name("dip_direction_deg"), "dipdirection");
  EXPECT_EQ(plain_name("Strike (Left)"), "strikeleft");
}

TEST(ColumnText, WhatIsNoTextIsRefused) {
  for (const char* words : {"", "# nothing\n", "name\n"})
    EXPECT_THROW(static_cast<void>(parse_columns(words, "f")), InputError) << words;
  EXPECT_THROW(static_cast<void>(parse_columns(std::string("1\0 2", 4), "f")), InputError);
}

}  // namespace
