// Contours moved apart within the accuracy of a map.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "terrain/mend_meetings.hpp"

namespace {

using namespace talus;

void add(const std::vector<Vec2>& points, double height, ContourMap& map) {
  for (const Vec2& p : points) map.contours.points.emplace_back(p.x(), p.y(), height);
  map.contours.begin.push_back(static_cast<int>(map.contours.points.size()));
  map.contours.feature.push_back(map.contours.n_lines());
}

// Contours east to west, 20 m apart, that run together between 80 and 120 m: drawn as one line.
ContourMap cliff(int n_together) {
  ContourMap map;
  for (int k = 0; k < 11; ++k) {
    std::vector<Vec2> line;
    for (int i = 0; i <= 10; ++i) {
      const bool is_joined = i >= 4 && i <= 6 && k >= 5 - n_together / 2 && k <= 5 + n_together / 2;
      line.emplace_back(20 * i, is_joined ? 100 : 20 * k);
    }
    add(line, 1000 + 10 * k, map);
  }
  return map;
}

bool keeps_apart(const ContourMap& map) {
  std::vector<HeightConflict> conflicts;
  return try_clean_lines(map, conflicts).has_value();
}

// Where the contours cross x = 100, from south to north.
std::vector<double> heights_along(const ContourMap& map, double x) {
  std::vector<std::pair<double, double>> found;
  for (int l = 0; l < map.contours.n_lines(); ++l)
    for (int i = map.contours.begin[l]; i + 1 < map.contours.begin[l + 1]; ++i) {
      const Vec3 &a = map.contours.points[i], &b = map.contours.points[i + 1];
      if (a.x() <= x && b.x() > x)
        found.emplace_back(a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y()), a.z());
    }
  std::sort(found.begin(), found.end());
  std::vector<double> heights;
  for (const auto& [y, z] : found) heights.push_back(z);
  return heights;
}

TEST(MendMeetings, LinesDrawnAsOneKeepTheirOrder) {
  for (const int n : {3, 5, 7}) {
    ContourMap map = cliff(n);
    const std::vector<Vec3> before = map.contours.points;
    ASSERT_FALSE(keeps_apart(map));
    const Mending mending = mend_meetings(1, map);
    ASSERT_TRUE(keeps_apart(map)) << n;
    EXPECT_LE(mending.largest_move, 1);
    EXPECT_EQ(mending.meetings.size(), static_cast<std::size_t>(3 * n * (n - 1) / 2));
    for (const Meeting& meeting : mending.meetings) EXPECT_TRUE(meeting.is_mended);
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_LE((map.contours.points[i] - before[i]).head<2>().norm(), mending.largest_move);
      EXPECT_EQ(map.contours.points[i].z(), before[i].z());
    }
    for (const double x : {85.0, 101.0, 119.0}) {
      const std::vector<double> heights = heights_along(map, x);
      ASSERT_EQ(heights.size(), 11U);
      EXPECT_TRUE(std::is_sorted(heights.begin(), heights.end())) << n << " at " << x;
    }
  }
}

// A corner that a generalised line cuts off pokes through its neighbour.
TEST(MendMeetings, ACornerGoesBackToItsSide) {
  for (const double depth : {0.0, 0.5, 0.9}) {
    ContourMap map;
    add({{0, 0}, {50, 10 + depth}, {100, 0}}, 100, map);
    add({{0, 10}, {100, 10}}, 110, map);
    const Mending mending = mend_meetings(1, map);
    ASSERT_TRUE(keeps_apart(map)) << depth;
    ASSERT_EQ(mending.moved.size(), 1U);
    EXPECT_EQ(mending.moved[0].line, 0);
    EXPECT_NEAR(mending.largest_move, depth + 0.05, 1e-9);
    EXPECT_NEAR(map.contours.points[1].y(), 9.95, 1e-9);
  }
}

TEST(MendMeetings, TheLineWithACornerIsMovedWhicheverComesFirst) {
  ContourMap map;
  add({{0, 10}, {100, 10}}, 110, map);
  add({{0, 0}, {50, 10.5}, {100, 0}}, 100, map);
  const Mending mending = mend_meetings(1, map);
  ASSERT_TRUE(keeps_apart(map));
  EXPECT_EQ(mending.moved[0].line, 1);
}

TEST(MendMeetings, RingsAreMendedAcrossTheirStart) {
  ContourMap map;
  add({{50, 100.4}, {0, 50}, {50, 0}, {100, 50}, {50, 100.4}}, 100, map);  // starts at its corner
  add({{-50, 100}, {150, 100}}, 90, map);
  const Mending mending = mend_meetings(1, map);
  ASSERT_TRUE(keeps_apart(map));
  EXPECT_EQ(map.contours.points[0], map.contours.points[4]);
  EXPECT_NEAR(map.contours.points[0].y(), 99.95, 1e-9);
}

TEST(MendMeetings, WhatIsBeyondTheToleranceStaysAndIsListedWhole) {
  ContourMap map;
  add({{0, 0}, {100, 100}}, 100, map);  // crosses for good
  add({{0, 100}, {100, 0}}, 110, map);
  add({{200, 0}, {250, 10.5}, {300, 0}}, 100, map);  // within the tolerance
  add({{200, 10}, {300, 10}}, 110, map);
  add({{400, 0}, {450, 15}, {500, 0}}, 100, map);  // five metres too far
  add({{400, 10}, {500, 10}}, 110, map);
  const std::vector<Vec3> before = map.contours.points;
  const Mending mending = mend_meetings(1, map);
  EXPECT_EQ(map.contours.points, before);
  EXPECT_TRUE(mending.moved.empty());
  ASSERT_EQ(mending.meetings.size(), 5U);
  for (const Meeting& meeting : mending.meetings)
    EXPECT_EQ(meeting.is_mended, meeting.line_a == 2) << meeting.line_a;
  EXPECT_NEAR(mending.meetings[0].place.x(), 50, 1e-12);
}

// One line with two heights: nothing says where either belongs.
TEST(MendMeetings, ALineDigitisedTwiceAtTwoHeightsIsNotMended) {
  ContourMap map;
  for (const double height : {100.0, 110.0}) add({{0, 0}, {50, 10}, {100, 0}}, height, map);
  for (const Meeting& meeting : mend_meetings(5, map).meetings) EXPECT_FALSE(meeting.is_mended);
}

TEST(MendMeetings, WithoutAToleranceNothingIsMoved) {
  ContourMap map = cliff(3);
  const std::vector<Vec3> before = map.contours.points;
  const Mending mending = mend_meetings(0, map);
  EXPECT_EQ(map.contours.points, before);
  EXPECT_EQ(mending.meetings.size(), 9U);
}

// Lines generalised to a tolerance show about that tolerance.
TEST(AccuracyOfLines, IsTheSmallestOfTheirBends) {
  Polylines lines;
  for (int i = 0; i < 200; ++i)
    lines.points.emplace_back(10 * i, i % 2 == 0 ? 0 : 1.5 + 0.01 * (i % 100), 100);
  lines.begin.push_back(200);
  lines.feature.push_back(0);
  EXPECT_GT(accuracy_of_lines(lines), 1.5);
  EXPECT_LT(accuracy_of_lines(lines), 1.8);
  lines.begin.back() = 20;
  EXPECT_EQ(accuracy_of_lines(lines), 0);  // too few to judge by
}

}  // namespace
