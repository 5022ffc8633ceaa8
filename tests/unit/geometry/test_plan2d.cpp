// Distances, sides and rings in plan.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/plan2d.hpp"

namespace {

using talus::Vec2;
using talus::Vec3;

TEST(Cross, IsPositiveToTheLeft) {
  EXPECT_EQ(talus::cross(Vec2(2, 0), Vec2(1, 3)), 6);
  EXPECT_EQ(talus::cross(Vec2(1, 3), Vec2(2, 0)), -6);
}

TEST(DistanceToSegment, IsToItsNearestPoint) {
  const Vec2 a(0, 0), b(10, 0);
  EXPECT_EQ(talus::distance_to_segment<Vec2>({4, 3}, a, b), 3);
  EXPECT_EQ(talus::distance_to_segment<Vec2>({-3, 4}, a, b), 5);
  EXPECT_EQ(talus::distance_to_segment<Vec2>({13, -4}, a, b), 5);
  EXPECT_EQ(talus::distance_to_segment<Vec3>({5, 3, 4}, Vec3::Zero(), {10, 0, 0}), 5);
  EXPECT_EQ(talus::share_along_segment<Vec2>({4, 3}, a, b), 0.4);
}

TEST(DistanceToSegment, OfNoLengthIsThatToItsPoint) {
  const Vec2 a(1, 1);
  EXPECT_EQ(talus::distance_to_segment<Vec2>({4, 5}, a, a), 5);
  EXPECT_EQ(talus::distance_to_segment<Vec3>({1, 1, 3}, {1, 1, 1}, {1, 1, 1}), 2);
  EXPECT_EQ(talus::share_along_segment<Vec2>({4, 5}, a, a), 0);
}

TEST(IsInside, GoesByTheEvenOddRule) {
  const std::vector<Vec2> notched = {{0, 0}, {10, 0}, {10, 10}, {5, 2}, {0, 10}};
  EXPECT_TRUE(talus::is_inside(notched, {1, 5}));
  EXPECT_TRUE(talus::is_inside(notched, {5, 1}));
  EXPECT_FALSE(talus::is_inside(notched, {5, 5}));
  EXPECT_FALSE(talus::is_inside(notched, {-1, 5}));
  EXPECT_FALSE(talus::is_inside(notched, {11, 5}));
}

}  // namespace
