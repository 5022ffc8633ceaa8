// Reading files and CSV tables: quotes, remarks, byte order mark, refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"

namespace {

using namespace talus;

TEST(Csv, ReadsNamesRowsRemarksAndQuotes) {
  const CsvTable table = parse_csv("# a remark\n a , b\r\n\n1.5, \"x, \"\"y\"\"\"\n,2\n", "t.csv");
  EXPECT_EQ(table.names, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.number(0, "a"), 1.5);
  EXPECT_EQ(table.at(0, "b"), "x, \"y\"");
  EXPECT_TRUE(std::isnan(table.number(1, "a")));
  EXPECT_EQ(table.line, (std::vector<int>{4, 5}));
  EXPECT_EQ(csv_line({"x, \"y\"", "2", ""}), "\"x, \"\"y\"\"\",2,\n");
}

std::string finding_of(const std::string& content, const char* column) {
  try {
    (void)parse_csv(content, "t.csv").number(0, column);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Csv, SaysWhereItIsNoTable) {
  EXPECT_NE(finding_of("a,b\n1\n", "a").find("t.csv:2: has 1 values, expected 2"),
            std::string::npos);
  EXPECT_NE(finding_of("a\n1\n", "c").find("has no column c"), std::string::npos);
  EXPECT_NE(finding_of("a\none\n", "a").find("t.csv:2: a is \"one\", expected a number"),
            std::string::npos);
  EXPECT_NE(finding_of("a\n", "a").find("holds no row"), std::string::npos);
  EXPECT_NE(finding_of("a\n\"1\n", "a").find("a quote is not closed"), std::string::npos);
}

TEST(Csv, MayBeginWithAByteOrderMark) {
  EXPECT_EQ(parse_csv("\xEF\xBB\xBF"
                      "a,b\n1,2\n",
                      "t.csv")
                .number(0, "a"),
            1);
}

TEST(Csv, FillsShortRowsWhereTold) {
  const CsvTable table = parse_csv("a,b\n1\n", "t.csv", true);
  EXPECT_EQ(table.number(0, "a"), 1);
  EXPECT_TRUE(std::isnan(table.number(0, "b")));
}

TEST(ReadFile, RefusesWhatCannotBeRead) {
  EXPECT_THROW((void)read_file("/no/such/file"), InputError);
  EXPECT_THROW((void)read_file("/"), InputError);
}

}  // namespace
