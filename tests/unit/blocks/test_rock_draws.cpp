// Sizes of drawn rocks against their laws.
#include <gtest/gtest.h>

#include <cmath>

#include "blocks/rock_draws.hpp"
#include "blocks/shapes.hpp"
#include "geometry/polyhedron.hpp"

namespace {

using talus::power_law_volume;

// (low / V)^b of the rocks of a power law are larger than V, less those cut off above.
TEST(RockDraws, VolumesFollowTheTruncatedPowerLaw) {
  for (const double exponent : {0.5, 1.0, 2.3}) {
    const double low = 0.2, high = 5, tail = std::pow(low / high, exponent);
    for (const double u : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      const double v = power_law_volume(u, low, high, exponent);
      EXPECT_NEAR((1 - std::pow(low / v, exponent)) / (1 - tail), u, 1e-12) << exponent;
    }
  }
}

TEST(RockDraws, WithoutAnExponentLogarithmsAreEven) {
  EXPECT_NEAR(power_law_volume(0.5, 0.1, 10, 0), 1, 1e-12);
  EXPECT_NEAR(power_law_volume(0.5, 0.1, 10, 1e-9), 1, 1e-7);  // no jump
  EXPECT_EQ(power_law_volume(0.3, 2, 2, 1), 2);
}

// The three blocks have sides of 1:1:1, 2:1:1 and 2:2:1, the longest as given.
TEST(RockDraws, EotaBlocksHaveTheirProportions) {
  talus::Random random(1);
  const auto volume = [&](const char* name) {
    talus::ShapeSize size;
    size.extents = talus::Vec3::Constant(2);
    return talus::moments(talus::shape_kind(name).make(size, random)).volume;
  };
  const double cube = volume("eota111");
  EXPECT_NEAR(volume("eota211"), cube / 4, 1e-12);
  EXPECT_NEAR(volume("eota221"), cube / 2, 1e-12);
  EXPECT_NEAR(cube, volume("eota"), 1e-12);
}

}  // namespace
