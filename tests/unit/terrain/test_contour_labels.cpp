// Heights of contours from labels.
#include <gtest/gtest.h>

#include <cmath>

#include "terrain/contour_labels.hpp"

namespace {

using namespace talus;

void add(const std::vector<Vec2>& points, Polylines& lines) {
  for (const Vec2& p : points) lines.points.emplace_back(p.x(), p.y(), 0);
  lines.begin.push_back(static_cast<int>(lines.points.size()));
  lines.feature.push_back(lines.n_lines());
}

// Straight contours 20 m apart; the third is broken for its label, the fourth in two pieces.
Polylines map() {
  Polylines lines;
  add({{0, 0}, {200, 0}}, lines);
  add({{0, 20}, {200, 20}}, lines);
  add({{0, 40}, {90, 40}}, lines);
  add({{110, 40}, {200, 40}}, lines);
  add({{0, 60}, {100, 60}}, lines);
  add({{100, 60}, {200, 60}}, lines);
  return lines;
}

TEST(ContourLabels, GoToTheNearestLineAcrossGapsAndJoints) {
  const LabelledLines found =
      heights_from_labels(map(), {{50, 2, 100}, {150, 18, 110}, {100, 40, 120}, {30, 61, 130}});
  EXPECT_EQ(found.height, (std::vector<double>{100, 110, 120, 120, 130, 130}));
  EXPECT_TRUE(found.without.empty());
  EXPECT_TRUE(found.unclear.empty());
  EXPECT_EQ(found.line_at_two, -1);
}

TEST(ContourLabels, WhatIsUnclearOrMissingIsListed) {
  const LabelledLines found = heights_from_labels(map(), {{50, 9, 100}, {150, 18, 110}});
  EXPECT_EQ(found.unclear, (std::vector<int>{0}));
  EXPECT_EQ(found.without, (std::vector<int>{0, 2, 3, 4, 5}));
  EXPECT_TRUE(std::isnan(found.height[0]));
}

// Between the ends of two contours at the edge of a sheet a label is of neither.
TEST(ContourLabels, EndsSideBySideAreNoGap) {
  const LabelledLines found = heights_from_labels(map(), {{201, 10, 100}});
  EXPECT_EQ(found.unclear.size(), 1U);
  EXPECT_EQ(found.without.size(), 6U);
}

TEST(ContourLabels, TwoHeightsOfOneLineAreFound) {
  const LabelledLines found =
      heights_from_labels(map(), {{20, 61, 130}, {150, 59, 140}, {50, 2, 100}});
  EXPECT_EQ(found.line_at_two, 5);
  EXPECT_EQ(found.two_heights, (std::array<double, 2>{130, 140}));
}

}  // namespace
