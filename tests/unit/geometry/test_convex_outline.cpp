// Convex outlines of points.
#include <gtest/gtest.h>

#include "geometry/convex_outline.hpp"

namespace {

using talus::convex_outline;
using talus::Vec2;

TEST(ConvexOutline, LeavesOutPointsOnSidesInsideAndTwice) {
  const auto hull = convex_outline({{0, 0}, {2, 0}, {1, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 0}});
  const std::vector<Vec2> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_EQ(hull, square);
}

TEST(ConvexOutline, OfFewerThanThreePointsIsThePoints) {
  EXPECT_TRUE(convex_outline({}).empty());
  const std::vector<Vec2> two = {{0, 0}, {1, 1}};
  EXPECT_EQ(convex_outline({{1, 1}, {0, 0}, {1, 1}}), two);
}

}  // namespace
