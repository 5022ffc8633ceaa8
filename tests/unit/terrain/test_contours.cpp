// Cleaning of contour maps.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.hpp"
#include "terrain/contours.hpp"

namespace {

using talus::clean_lines;
using talus::CleanLines;
using talus::ContourMap;
using talus::Polylines;
using talus::Vec2;
using talus::Vec3;

void add_line(Polylines& lines, const std::vector<Vec3>& points) {
  lines.points.insert(lines.points.end(), points.begin(), points.end());
  lines.begin.push_back(static_cast<int>(lines.points.size()));
  lines.feature.push_back(lines.n_lines());
}

void add_contour(ContourMap& map, double height, const std::vector<Vec2>& places) {
  std::vector<Vec3> points;
  for (const Vec2& p : places) points.emplace_back(p.x(), p.y(), height);
  add_line(map.contours, points);
}

// Two contours 10 m apart in height, so that the interval is 10 m.
ContourMap two_contours() {
  ContourMap map;
  map.source = "map.gpkg";
  map.origin = Vec3(1000, 2000, 0);
  add_contour(map, 100, {{0, 0}, {10, 0}, {20, 0}});
  add_contour(map, 110, {{0, 50}, {10, 50}, {20, 50}});
  return map;
}

std::string refusal(const ContourMap& map) {
  try {
    static_cast<void>(clean_lines(map));
  } catch (const talus::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Cleaning, LeavesACleanMapAsItIs) {
  const CleanLines clean = clean_lines(two_contours());
  EXPECT_EQ(clean.points.size(), 6U);
  EXPECT_EQ(clean.segments.size(), 4U);
  EXPECT_EQ(clean.n_contour_points, 6);
  EXPECT_EQ(clean.counts.duplicate_points, 0U);
}

TEST(Cleaning, CountsPointsAndSegmentsDigitisedTwice) {
  ContourMap map = two_contours();
  add_contour(map, 100, {{20, 0}, {20, 0}, {10, 0}});  // repeats a point, then a segment backwards
  const CleanLines clean = clean_lines(map);
  EXPECT_EQ(clean.points.size(), 6U);
  EXPECT_EQ(clean.segments.size(), 4U);
  EXPECT_EQ(clean.counts.duplicate_points, 3U);
  EXPECT_EQ(clean.counts.duplicate_segments, 1U);
}

TEST(Cleaning, AClosedLineIsNoDuplicate) {
  ContourMap map = two_contours();
  add_contour(map, 120, {{0, 80}, {5, 80}, {5, 85}, {0, 80}});
  const CleanLines clean = clean_lines(map);
  EXPECT_EQ(clean.counts.duplicate_points, 0U);
  EXPECT_EQ(clean.segments.size(), 7U);
}

TEST(Cleaning, ALineOfOnePlaceBecomesAPoint) {
  ContourMap map = two_contours();
  add_contour(map, 120, {{3, 80}, {3, 80}});
  const CleanLines clean = clean_lines(map);
  EXPECT_EQ(clean.counts.single_points, 1U);
  EXPECT_EQ(clean.points.size(), 7U);
  EXPECT_EQ(clean.segments.size(), 4U);
}

TEST(Cleaning, JoinsContoursThatTouchOrCrossAtOneHeight) {
  ContourMap map = two_contours();
  add_contour(map, 100, {{5, 0}, {5, -10}});     // ends on the first contour
  add_contour(map, 100, {{15, 10}, {15, -10}});  // crosses it
  const CleanLines clean = clean_lines(map);
  EXPECT_EQ(clean.counts.touches, 1U);
  EXPECT_EQ(clean.counts.crossings, 1U);
  EXPECT_EQ(clean.segments.size(), 4U + 1 + 1 + 2 + 1);
  EXPECT_EQ(clean.points.size(), 6U + 2 + 2 + 1);
  for (const Vec3& p : clean.points)
    if (p.x() == 15 && p.y() == 0) {
      EXPECT_EQ(p.z(), 100);
    }
}

TEST(Cleaning, RefusesACrossingAtTwoHeightsWithPlaceAndHeights) {
  ContourMap map = two_contours();
  add_contour(map, 120, {{5, -10}, {5, 10}});
  const std::string message = refusal(map);
  EXPECT_NE(message.find("map.gpkg"), std::string::npos) << message;
  EXPECT_NE(message.find("at 100 m"), std::string::npos) << message;
  EXPECT_NE(message.find("at 120 m"), std::string::npos) << message;
  EXPECT_NE(message.find("x 1005, y 2000"), std::string::npos) << message;
}

TEST(Cleaning, RefusesATouchAndASharedPointAtTwoHeights) {
  ContourMap touch = two_contours();
  add_contour(touch, 120, {{5, 0}, {5, 10}});
  EXPECT_NE(refusal(touch).find("x 1005, y 2000"), std::string::npos);
  ContourMap shared = two_contours();
  add_contour(shared, 120, {{10, 0}, {5, 10}});
  EXPECT_NE(refusal(shared).find("x 1010, y 2000"), std::string::npos);
}

TEST(Cleaning, CountsAllPlacesItRefuses) {
  ContourMap map = two_contours();
  add_contour(map, 120, {{5, -10}, {5, 10}, {15, 10}, {15, -10}});
  EXPECT_NE(refusal(map).find("1 more place"), std::string::npos) << refusal(map);
}

TEST(Cleaning, ABreaklineTakesTheHeightOfTheContourItMeets) {
  ContourMap map = two_contours();
  add_line(map.breaklines, {{5, -20, 97}, {5, 20, 104}});  // 101 m where the contour is at 100 m
  map.spots = {{15, 0, 103}, {40, 40, 107}};
  const CleanLines clean = clean_lines(map);
  EXPECT_EQ(clean.counts.breakline_meetings, 2U);
  EXPECT_EQ(clean.n_contour_points, 6 + 1);  // the crossing is a point of the contour
  int n_found = 0;
  for (const Vec3& p : clean.points) {
    if (p.y() != 0 || (p.x() != 5 && p.x() != 15)) continue;
    EXPECT_EQ(p.z(), 100);
    ++n_found;
  }
  EXPECT_EQ(n_found, 2);
}

TEST(Cleaning, RefusesABreaklineMoreThanHalfAnIntervalOffTheContour) {
  ContourMap map = two_contours();
  add_line(map.breaklines, {{5, -20, 100}, {5, 20, 112.2}});  // 106.1 m there
  EXPECT_NE(refusal(map).find("breakline"), std::string::npos) << refusal(map);
}

// Splitting moves lines by rounding; the result must have no meetings left all the same.
TEST(Cleaning, SettlesWhenManyLinesCrossInObliquePlaces) {
  ContourMap map;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.07 * i + 0.01;
    const Vec2 along(std::cos(angle), std::sin(angle));
    const Vec2 centre(std::sin(7.0 * i), std::cos(3.0 * i));
    add_contour(map, 100, {centre - 50 * along, centre + 50 * along});
  }
  add_contour(map, 110, {{200, 0}, {200, 10}});
  const CleanLines once = clean_lines(map);
  EXPECT_GT(once.counts.crossings, 400U);
  ContourMap again;
  for (const auto& [a, b] : once.segments)
    add_line(again.contours,
             {once.points[static_cast<std::size_t>(a)], once.points[static_cast<std::size_t>(b)]});
  const CleanLines twice = clean_lines(again);
  EXPECT_EQ(twice.counts.crossings + twice.counts.touches, 0U);
  EXPECT_EQ(twice.points.size(), once.points.size());
}

TEST(ContourInterval, IsTheUsualStepBetweenHeights) {
  ContourMap map;
  for (const double height : {100.0, 110.0, 120.0, 125.0, 130.0, 140.0, 140.0005, 150.0})
    add_contour(map, height, {{0, height}, {1, height}});
  EXPECT_EQ(talus::contour_levels(map).size(), 7U);  // half a millimetre is not a step
  EXPECT_EQ(talus::contour_interval(map), 10);
}

TEST(HoldingBack, TakesEveryKthHeightButNeverTheHighest) {
  ContourMap map;
  for (int i = 0; i < 9; ++i)
    add_contour(map, 100 + 5 * i, {{0.0, 1.0 * i}, {1.0, 1.0 * i}, {2.0, 1.0 * i}});
  const std::vector<Vec3> held_back = talus::hold_back_contours(3, map);
  EXPECT_EQ(map.contours.n_lines(), 7);
  ASSERT_EQ(held_back.size(), 6U);
  EXPECT_EQ(held_back.front().z(), 110);
  EXPECT_EQ(held_back.back().z(), 125);
  EXPECT_EQ(talus::contour_levels(map).back(), 140);
}

TEST(Heights, OneHeightIsRefused) {
  ContourMap map;
  add_contour(map, 100, {{0, 0}, {1, 0}});
  EXPECT_THROW(talus::check_heights(map), talus::InputError);
  add_contour(map, 110, {{0, 1}, {1, 1}});
  EXPECT_NO_THROW(talus::check_heights(map));
}

}  // namespace
