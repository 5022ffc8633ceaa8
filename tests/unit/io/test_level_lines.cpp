// Level lines of sampled fields.
#include <gtest/gtest.h>

#include <cmath>

#include "io/level_lines.hpp"

using namespace talus;

// The lines of a plane are straight, and are where it has their height.
TEST(LevelLines, OfAPlaneStandWhereItHasTheirHeight) {
  SampledField field{{10, 50}, 2, 5, 8, {}};
  for (int row = 0; row < 5; ++row)
    for (int col = 0; col < 8; ++col) field.value.push_back(3.0 * col + row);
  const std::vector<LevelLine> lines = level_lines(field, {4, 11.5, 100});
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].level, 4);
  EXPECT_EQ(lines[1].level, 11.5);
  for (const LevelLine& line : lines) {
    EXPECT_GE(line.points.size(), 2U);
    for (const Vec2& p : line.points)
      EXPECT_NEAR(3 * (p.x() - 10) / 2 + (50 - p.y()) / 2, line.level, 1e-5);
  }
}

TEST(LevelLines, RowsMayGoToTheNorth) {
  const SampledField field{{0, 0}, 1, 2, 2, {0, 0, 2, 2}, 1};
  const std::vector<LevelLine> lines = level_lines(field, {0.5});
  ASSERT_EQ(lines.size(), 1U);
  for (const Vec2& p : lines[0].points) EXPECT_NEAR(p.y(), 0.25, 1e-9);
}

TEST(LevelLines, CloseAroundATopAndStopAtUnknownGround) {
  SampledField cone{{0, 0}, 1, 21, 21, {}};
  for (int row = 0; row < 21; ++row)
    for (int col = 0; col < 21; ++col) cone.value.push_back(10 - std::hypot(col - 10, row - 10));
  std::vector<LevelLine> lines = level_lines(cone, {3.3});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points.front(), lines[0].points.back());
  double length = 0;
  for (std::size_t i = 1; i < lines[0].points.size(); ++i)
    length += (lines[0].points[i] - lines[0].points[i - 1]).norm();
  EXPECT_NEAR(length, 2 * M_PI * 6.7, 0.02 * length);

  cone.value[10 * 21 + 17] = std::nan("");  // on the line, to the east
  lines = level_lines(cone, {3.3});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].points.front(), lines[0].points.back());
  for (const Vec2& p : lines[0].points) EXPECT_FALSE(p.x() > 16.1 && std::abs(p.y() + 10) < 0.9);
}

TEST(LevelLines, AreNoneOfNothing) {
  EXPECT_TRUE(level_lines({}, {1}).empty());
  EXPECT_TRUE(level_lines({{0, 0}, 1, 2, 2, {1, 1, 1, 1}}, {}).empty());
  EXPECT_TRUE(level_lines({{0, 0}, 1, 2, 2, {1, 1, 1, 1}}, {3}).empty());
}
