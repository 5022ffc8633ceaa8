// Rims of footprints.
#include <gtest/gtest.h>

#include <cmath>

#include "io/polygons_gdal.hpp"

using namespace talus;

namespace {

std::vector<Vec2> box(double west, double south, double east, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}};
}

double area(const std::vector<Vec2>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return std::abs(twice) / 2;
}

}  // namespace

// 10 x 10 and 10 x 6 that overlap by 2 x 6: 100 + 60 - 12.
TEST(RimOf, JoinsFootprintsThatOverlap) {
  const auto rim = rim_of({box(0, 0, 10, 10), box(8, 2, 18, 8)});
  ASSERT_EQ(rim.size(), 1U);
  EXPECT_NEAR(area(rim[0]), 148, 0.1);
}

TEST(RimOf, ClosesJointsAndKeepsWhatIsApart) {
  EXPECT_EQ(rim_of({box(0, 0, 10, 10), box(10.1, 0, 20, 10)}).size(), 1U);
  EXPECT_EQ(rim_of({box(0, 0, 10, 10), box(10.5, 0, 20, 10)}).size(), 2U);
  EXPECT_EQ(rim_of({box(0, 0, 10, 10), box(10.5, 0, 20, 10)}, 1).size(), 1U);
  EXPECT_TRUE(rim_of({}).empty());
}
