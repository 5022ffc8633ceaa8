// Contours and points with wrong heights.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "terrain/outliers.hpp"

namespace {

using namespace talus;

// Straight contours east to west, 20 m apart in plan, with measured points beside them.
struct Map {
  std::vector<double> heights;
  std::vector<std::vector<Vec3>> measured;
};

void add(const std::vector<Vec3>& points, int line, bool is_line, std::vector<Vec3>& all,
         std::vector<std::array<int, 2>>& segments, LinesOfPoints& lines) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int id = static_cast<int>(all.size());
    if (i > 0 && is_line) segments.push_back({id - 1, id});
    all.push_back(points[i]);
    lines.line.push_back(line);
  }
}

std::vector<Outlier> doubts(const Map& map, double interval = 10) {
  std::vector<Vec3> points;
  std::vector<std::array<int, 2>> segments;
  LinesOfPoints lines;
  for (std::size_t l = 0; l < map.heights.size(); ++l) {
    std::vector<Vec3> contour;
    for (int i = 0; i <= 10; ++i)
      contour.emplace_back(20 * i, 20 * static_cast<double>(l), map.heights[l]);
    add(contour, lines.n_lines++, true, points, segments, lines);
  }
  lines.n_contour_points = static_cast<int>(points.size());
  for (const auto& measured : map.measured)
    add(measured, lines.n_lines++, measured.size() > 1, points, segments, lines);
  Triangulation triangulation(points, segments, "map");
  return find_outliers(triangulation.mesh(), lines, interval);
}

std::vector<double> rising(int n, double interval = 10) {
  std::vector<double> heights;
  for (int i = 0; i < n; ++i) heights.push_back(1000 + interval * i);
  return heights;
}

TEST(Outliers, AWrongLabelIsNamedWithWhatStandsBesideIt) {
  for (const double wrong : {1150.0, 0.0, 1080.0, 1020.0}) {  // right: 1050
    Map map{rising(11), {}};
    map.heights[5] = wrong;
    const std::vector<Outlier> found = doubts(map);
    ASSERT_EQ(found.size(), 1U) << wrong;
    EXPECT_EQ(found[0].line, 5);
    EXPECT_EQ(found[0].place.y(), 100);
    EXPECT_EQ(found[0].low, 1040);
    EXPECT_EQ(found[0].high, 1060);
  }
}

// The last contour is as far off the wrong one beside it as that from it.
TEST(Outliers, AtTheRimTheWrongOneOfTwoIsNamed) {
  for (const int wrong : {0, 1, 9, 10}) {
    Map map{rising(11), {}};
    map.heights[static_cast<std::size_t>(wrong)] += 500;
    const std::vector<Outlier> found = doubts(map);
    ASSERT_EQ(found.size(), 1U) << wrong;
    EXPECT_EQ(found[0].line, wrong);
  }
}

TEST(Outliers, SlopesCliffsAndOtherIntervalsAreLeftAlone) {
  EXPECT_TRUE(doubts({rising(11), {}}).empty());
  EXPECT_TRUE(doubts({{1000, 1010, 1020, 1110, 1200, 1210, 1220}, {}}).empty());      // a cliff
  EXPECT_TRUE(doubts({{1000, 1010, 1020, 1030, 1030, 1020, 1010}, {}}).empty());      // a ridge
  EXPECT_TRUE(doubts({{1000, 1100, 1200, 1300, 1200, 1100, 1000}, {}}, 10).empty());  // every 100
  EXPECT_TRUE(doubts({{1000, 1010, 1030, 1010, 1000}, {}}, 20).empty());
}

TEST(Outliers, SpotHeightsFarBesideTheContoursAreNamed) {
  const Vec3 right(50, 92, 1046), on_the_top(60, 90, 1069);
  EXPECT_TRUE(doubts({rising(11), {{right}}}).empty());
  EXPECT_TRUE(doubts({rising(11), {{on_the_top}}}).empty());
  for (const double wrong : {0.0, 346.0, 1460.0, 1081.0}) {
    const std::vector<Outlier> found =
        doubts({rising(11), {{Vec3(150, 30, 1015)}, {Vec3(50, 92, wrong)}}});
    ASSERT_EQ(found.size(), 1U) << wrong;
    EXPECT_EQ(found[0].line, 12);
    EXPECT_EQ(found[0].place.z(), wrong);
    EXPECT_EQ(found[0].low, 1040);
    EXPECT_EQ(found[0].high, 1050);
  }
}

// A breakline is named once, at a point that is off, although its other points are not.
TEST(Outliers, ABreaklineIsNamedAtAPointThatIsOff) {
  const std::vector<Outlier> found =
      doubts({rising(11), {{Vec3(45, 65, 1032), Vec3(50, 70, 3200), Vec3(55, 75, 3300)}}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 11);
  EXPECT_EQ(found[0].place.z(), 3200);
}

// 150 m above neighbours 20 m away is in doubt; a kilometre below them is not ground.
TEST(Outliers, WhatNoGroundCanBeIsTold) {
  for (const auto& [wrong, is_impossible] :
       {std::pair{1150.0, false}, {1260.0, false}, {1261.0, true}, {0.0, true}, {839.0, true}}) {
    Map map{rising(11), {}};
    map.heights[5] = wrong;
    const std::vector<Outlier> found = doubts(map);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].is_impossible, is_impossible) << wrong;
  }
  const auto spot = doubts({rising(11), {{Vec3(50, 92, 3431)}, {Vec3(150, 92, 1120)}}});
  ASSERT_EQ(spot.size(), 2U);
  EXPECT_TRUE(spot[0].is_impossible);
  EXPECT_FALSE(spot[1].is_impossible);
}

// Both lie far within the heights of the contours beside them.
TEST(Outliers, OfTwoSpotHeightsInOnePlaceTheUpperOneIsNamed) {
  for (const double gap : {0.05, 0.3}) {
    const std::vector<Outlier> found =
        doubts({rising(11), {{Vec3(50, 92, 1046)}, {Vec3(50 + gap, 92, 1049)}}});
    ASSERT_EQ(found.size(), 1U) << gap;
    EXPECT_EQ(found[0].line, 12);
    EXPECT_EQ(found[0].low, 1046);
    EXPECT_FALSE(found[0].is_impossible);
  }
  const Vec3 foot(50, 92, 1046), top(50.05, 92, 1049);
  EXPECT_TRUE(doubts({rising(11), {{foot}, {Vec3(50.05, 92, 1046.4)}}}).empty());
  EXPECT_TRUE(doubts({rising(11), {{foot}, {Vec3(51, 92, 1049)}}}).empty());
  // a breakline between them, or at one of them, is the edge of a wall
  const std::vector<Vec3> edge = {Vec3(50.02, 88, 1049), Vec3(50.02, 96, 1049)};
  EXPECT_TRUE(doubts({rising(11), {edge, {foot}, {top}}}).empty());
  EXPECT_TRUE(doubts({rising(11), {{top, Vec3(60, 92, 1046)}, {foot}}}).empty());
}

TEST(Outliers, ASpotHeightBesideAContourGoesWithIt) {
  for (const double wrong : {1058.0, 1042.0}) {
    const std::vector<Outlier> found = doubts({rising(11), {{Vec3(57, 100.05, wrong)}}});
    ASSERT_EQ(found.size(), 1U) << wrong;
    EXPECT_EQ(found[0].low, 1050);
  }
  EXPECT_TRUE(doubts({rising(11), {{Vec3(57, 100.05, 1054)}}}).empty());
  EXPECT_TRUE(doubts({rising(11), {{Vec3(57, 100.7, 1058)}}}).empty());
}

}  // namespace
