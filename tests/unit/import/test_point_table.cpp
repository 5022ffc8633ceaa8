// Tables of points: delimiters, columns, decimal marks.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "import/point_table.hpp"

namespace {

using namespace talus;

std::string refusal(const std::string& text, const std::string& name = "p.csv") {
  try {
    static_cast<void>(parse_point_table(text, name));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_found(const std::string& found, const std::string& words) {
  EXPECT_NE(found.find(words), std::string::npos) << found;
}

}  // namespace

TEST(PointTable, EverySignThatPartsColumnsGivesTheSamePoints) {
  for (const std::string text :
       {"x,y,z\n500000.5,5200000,1234.5\n500001,5200001,1235\n",
        "\xEF\xBB\xBFz;y;x\r\n1234,5;5200000;500000,5\r\n1235;5200001;500001\r\n",
        "Easting [m]\tNorthing [m]\tz\n500000.5\t5200000\t1234.5\n500001\t5200001\t1235\n",
        "500000.5 5200000  1234.5\n\n500001 5200001 1235",
        "# a remark\n//X Y Z\n"
        "500000,5 5200000 1234,5\n500001 5200001 1235\n",
        "\"id\",\"E\",\"N\",\"z\"\n\"a, "
        "b\",\"500000.5\",5200000,1234.5\nc,500001,5200001,1235\n"}) {
    const PointTable table = parse_point_table(text, "p.txt");
    ASSERT_EQ(table.points.size(), 2u) << text;
    EXPECT_EQ(table.points[0], Vec2(500000.5, 5200000)) << text;
    const int z = find_column(table.columns, {"z"});
    ASSERT_GE(z, 0) << text;
    EXPECT_TRUE(table.is_number[z]);
    double height = 0;
    EXPECT_TRUE(parse_number(table.columns, table.columns.rows[0][z], height));
    EXPECT_EQ(height, 1234.5) << text;
    EXPECT_FALSE(table.is_degrees);
  }
}

TEST(PointTable, MetresGoBeforeDegreesAndTheColumnsAreSaid) {
  const PointTable table =
      parse_point_table("lon,lat,Rechtswert,Hochwert\n11.5,47.1,650000,5220000\n", "p.csv");
  EXPECT_EQ(table.points[0], Vec2(650000, 5220000));
  EXPECT_EQ(table.columns.names[table.x], "Rechtswert");
  EXPECT_EQ(table.columns.names[table.y], "Hochwert");
  const PointTable degrees = parse_point_table("Latitude;Longitude\n47,1;11,5\n", "p.csv");
  EXPECT_TRUE(degrees.is_degrees);
  EXPECT_EQ(degrees.points[0], Vec2(11.5, 47.1));
}

TEST(PointTable, WhatIsNoNumberIsRefusedWithItsLine) {
  expect_found(refusal("x,y\n1,2\n3,n/a\n"), "p.csv:3: says \"n/a\", expected a number");
  expect_found(refusal("x,y\n1,2\n3,\n"), "p.csv:3: says \"\"");
  expect_found(refusal("x;y\n1.234,5;2\n"), "1.234,5");
  expect_found(refusal("x;y\n1,5;2\n3;4.5\n"), "a decimal comma and with a point");
  expect_found(refusal("x,y,z\n1,2,3\n4,5\n"), "p.csv:3: has 2 columns, expected 3");
}

TEST(PointTable, ColumnsThatCannotBeToldAreRefused) {
  expect_found(refusal("a,b,c\n1,2,3\n"), "expected columns named x and y");
  expect_found(refusal("x,y,easting,northing\n1,2,3,4\n"), "x and y, and easting and northing");
  expect_found(refusal("1 500000 5200000 1000\n2 500001 5200000 1001\n"), "counts the rows");
  expect_found(refusal("412 520 1010 115\n207 522 1033 116\n655 541 1008 126\n"), "point number");
  expect_found(
      refusal("412.0 520.5 1010.5 115.2\n207.0 522.5 1033.5 116.2\n655.0 541.5 1008.5 9\n"),
      "point number");
  expect_found(refusal("7012,500.1,700.2,99.5\n7098,510.2,710.4,98\n"), "whole numbers alone");
  expect_found(refusal("5.1,500.1,700.2,99.5,FENCE\n9,5.2,7.4,98,TREE\n"), "holds words");
  for (const char* empty : {"# nothing\n", "", "x,y\n"})
    expect_found(refusal(empty), "holds no line with a number");
  expect_found(refusal(std::string("\xFF\xFEx", 3)), "UTF-16");
}

TEST(PointTable, ListsOfPointsWithoutNumbersAreRead) {
  EXPECT_EQ(
      parse_point_table("650000 5200000 1010.5 7\n650005 5200005 1011 8\n", "p.xyz").points.size(),
      2u);
  EXPECT_EQ(parse_point_table("1.5 2.5 3.5 4\n2.5 3.5 4.5 5\n", "p.xyz").points.size(), 2u);
}

TEST(PointTable, HeightsThatMayHaveThousandsStayText) {
  const PointTable doubtful = parse_point_table("x,y,z\n1,2,990\n2,3,1.010\n", "p.csv");
  EXPECT_FALSE(doubtful.is_number[2]);
  EXPECT_TRUE(parse_point_table("x,y,z\n1,2,990.5\n2,3,1.010\n", "p.csv").is_number[2]);
}

TEST(PointTable, AColumnOfGeometriesIsKnown) {
  EXPECT_TRUE(has_wkt_column("id;WKT\n1;POINT (1 2)\n"));
  EXPECT_FALSE(has_wkt_column("x,y,z\n1,2,3\n"));
}
