// Escapes of control, direction and invalid characters.
#include <gtest/gtest.h>

#include <string>

#include "base/csv.hpp"
#include "base/printable.hpp"
#include "base/text.hpp"

namespace {

using namespace talus;

TEST(Printable, WhatSteersATerminalStandsAsItsNumber) {
  EXPECT_EQ(printable("a\x1b[2J\x07"
                      "b\x7f"),
            "a\\x1b[2J\\x07"
            "b\\x7f");
  EXPECT_EQ(printable("a\rb"),
            "a\\x0d"
            "b");
  EXPECT_EQ(printable(std::string("a\0b", 3)),
            "a\\x00"
            "b");
  EXPECT_EQ(printable("\xc2\x9b"
                      "2J"),
            "\\x9b"
            "2J");                                                        // C1, as UTF-8
  EXPECT_EQ(printable("safe\xe2\x80\xaetxt.exe"), "safe\\u202etxt.exe");  // right to left
  EXPECT_EQ(printable("a\xe2\x80\xa8"
                      "b\xe2\x81\xa6"),
            "a\\u2028"
            "b\\u2066");
}

TEST(Printable, BytesThatAreNoUtf8StandAsTheirNumbers) {
  EXPECT_EQ(printable("h\xf6hen"), "h\\xf6hen");
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");           // "/" in too many bytes
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a pair
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(printable("end\xe2\x82"), "end\\xe2\\x82");  // cut off
}

TEST(Printable, TextOfAnyAlphabetStaysAndNothingIsAddedTwice) {
  for (const std::string words : {"H\xc3\xb6hen \xe5\xb1\xb1 \xf0\x9f\x8f\x94, 3 \xc2\xb0",
                                  "two\nlines\tand a tab", "C:\\map"})
    EXPECT_EQ(printable(words), words);
  std::string bytes;
  for (int b = 0; b < 256; ++b) bytes += static_cast<char>(b);
  EXPECT_EQ(printable(printable(bytes)), printable(bytes));
}

TEST(Printable, InJsonAnEscapeMeansTheSame) {
  EXPECT_EQ(printable_json("[\"a\x7f\xe2\x80\xae\"]"), "[\"a\\u007f\\u202e\"]");
  EXPECT_EQ(printable_json("{\n  \"h\xc3\xb6\": 1\n}"), "{\n  \"h\xc3\xb6\": 1\n}");
}

TEST(Printable, TablesAndPagesTakeTheirTextThroughIt) {
  EXPECT_EQ(csv_line({"a\x1b[2J", "b,\xf6", "c"}), "a\\x1b[2J,\"b,\\xf6\",c\n");
  EXPECT_EQ(xml_escaped("<\xf6>\xe2\x80\xae"), "&lt;\\xf6&gt;\\u202e");
}

}  // namespace
