// Factor of safety over a bed: planes, wedges, rising feet.
#include <gtest/gtest.h>

#include <cmath>

#include "blocks/bed_equilibrium.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

const double tangent = std::tan(30 * degree);

Vec2 gradient(double dip_deg, double direction_deg) {
  const double a = direction_deg * degree;
  return -std::tan(dip_deg * degree) * Vec2(std::sin(a), std::cos(a));
}

}  // namespace

TEST(BedEquilibrium, OfAPlaneIsFrictionOverItsDip) {
  const std::vector<BedColumn> columns = {{gradient(40, 180), 3, tangent, 0},
                                          {gradient(40, 180), 1, tangent, 0}};
  EXPECT_NEAR(factor_along(columns, 180 * degree), 0.688059, 5e-7);
  const BedEquilibrium least = least_factor(columns, 165 * degree);
  EXPECT_NEAR(least.azimuth / degree, 180, 0.15);
  EXPECT_NEAR(least.factor, 0.688059, 2e-6);
}

TEST(BedEquilibrium, OfAWedgeIsItsFactor) {
  const std::vector<BedColumn> columns = {{gradient(60, 130), 1, tangent, 0},
                                          {gradient(60, 230), 1, tangent, 0}};
  EXPECT_NEAR(factor_along(columns, 180 * degree), 0.6930475, 5e-8);
}

// Two columns, one falls at 50 degrees, one rises at 10: they balance at a known ratio of weights.
TEST(BedEquilibrium, RisingColumnHoldsByItsFullNormalForce) {
  const auto factor = [](double ratio) {
    return factor_along(std::vector<BedColumn>{{gradient(50, 180), 1, tangent, 0},
                                               {gradient(-10, 180), ratio, tangent, 0}},
                        180 * degree);
  };
  EXPECT_NEAR(factor(std::tan(20 * degree) / std::tan(40 * degree)), 1, 1e-9);
  EXPECT_NEAR(std::tan(20 * degree) / std::tan(40 * degree), 0.433763, 5e-7);
  EXPECT_NEAR(factor(2 * std::tan(20 * degree) / std::tan(40 * degree)), 1.446332, 5e-7);
}

TEST(BedEquilibrium, NothingDrivesALevelBed) {
  EXPECT_TRUE(std::isinf(factor_along(std::vector<BedColumn>{{Vec2::Zero(), 1, tangent, 0}}, 0)));
}
