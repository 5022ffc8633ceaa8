#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "base/units.hpp"
#include "blocks/limit_equilibrium.hpp"

namespace {

using namespace talus;

// As Hoek and Bray print it, in forces across and along the plane.
TEST(SlidingFactor, IsThatOfPlaneFailure) {
  Random random(3, "plane failure");
  for (int trial = 0; trial < 100; ++trial) {
    const double d = random.uniform(20, 60) * degree, W = random.uniform(50, 100);
    const double U = random.uniform(0, 10), V = random.uniform(0, 10), k = random.uniform(0, 0.2);
    const double tangent = random.uniform(0.2, 1), cohesion = random.uniform(0, 20);
    const Vec3 normal(std::sin(d), 0, std::cos(d));
    const SlidingMass mass{W, U * normal + V * Vec3::UnitX(), {{normal, tangent, cohesion}}};
    const double exact =
        (cohesion + (W * (std::cos(d) - k * std::sin(d)) - U - V * std::sin(d)) * tangent) /
        (W * (std::sin(d) + k * std::cos(d)) + V * std::cos(d));
    EXPECT_NEAR(sliding_factor(mass, k * Vec3::UnitX()) / exact, 1, 1e-12);
    const double critical = critical_seismic(mass, 90 * degree);
    if (exact > 1) {
      EXPECT_GT(critical, k);
      EXPECT_NEAR(sliding_factor(mass, critical * Vec3::UnitX()), 1, 1e-9);
    }
  }
}

// Equal planes that make 90 - side degrees with the upright plane of their line, plunging i: W cos
// i - k W sin i is carried by two normal forces, each less the uplift.
TEST(SlidingFactor, IsThatOfAWedgeWithWater) {
  const double plunge = 30 * degree, side = 40 * degree, k = 0.1, uplift = 0.2, tangent = 0.5;
  const Vec3 line(std::cos(plunge), 0, -std::sin(plunge));
  const Vec3 up(std::sin(plunge), 0, std::cos(plunge));
  SlidingMass mass{1, Vec3::Zero(), {}};
  for (const double sign : {-1, 1}) {
    const Vec3 normal = std::cos(side) * up + sign * std::sin(side) * Vec3::UnitY();
    mass.planes.push_back({normal, tangent, 0.05});
    mass.water += uplift * normal;
  }
  const double pressed = (std::cos(plunge) - k * std::sin(plunge)) / (2 * std::cos(side)) - uplift;
  const double exact = 2 * (pressed * tangent + 0.05) / (std::sin(plunge) + k * std::cos(plunge));
  EXPECT_NEAR(line.dot(mass.planes[0].normal), 0, 1e-12);
  EXPECT_NEAR(sliding_factor(mass, k * Vec3::UnitX()) / exact, 1, 1e-12);
}

// The slope of the paper: sixteen columns of 10 m that rise by 1 m each, 4 m higher one by one up
// to the crest and 6.2 m less beyond; friction of 38.15 degrees just holds it.
TEST(TopplingFactor, IsThatOfGoodmanAndBray) {
  ColumnRow row{30 * degree, 10, 1, {}};
  for (int n = 1; n <= 10; ++n) row.height.push_back(4 * n);
  for (int n = 11; n <= 16; ++n) row.height.push_back(40 - 6.2 * (n - 10));
  EXPECT_NEAR(std::atan(1 / toppling_factor(row, 1)) / degree, 38.15, 0.05);
}

// A column falls over its toe where its base is steeper than its width over its height, whatever
// the friction; a lower one slides.
TEST(TopplingFactor, OfOneColumnIsThatOfSlidingOrNone) {
  const double friction = 0.7;
  EXPECT_EQ(toppling_factor({20 * degree, 1, 0, {1 / std::tan(20 * degree) * 1.01}}, friction), 0);
  EXPECT_NEAR(toppling_factor({20 * degree, 1, 0, {1 / std::tan(20 * degree) * 0.99}}, friction),
              friction / std::tan(20 * degree), 1e-9);
}

}  // namespace
