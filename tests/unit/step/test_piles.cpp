// Piles stand where rigid ones do: what a contact gives does not grow with what lies above it, with
// the step, or with small blocks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "step/step.hpp"
#include "unit/step/pile_scenes.hpp"

namespace {

using namespace talus;
using talus::test::Pile;

struct Named {
  const char* name;
  Pile pile;
};
std::string name_of(const testing::TestParamInfo<Named>& info) { return info.param.name; }

class PileStands : public testing::TestWithParam<Named> {};
INSTANTIATE_TEST_SUITE_P(
    Piles, PileStands,
    testing::Values(Named{"TowerOf8", {.high = 8, .share = 0.97}},
                    Named{"TowerOf16", {.high = 16, .share = 0.97}},
                    Named{"TowerOf16At20Ms", {.high = 16, .share = 0.93, .step = 0.02}},
                    Named{"TowerOf10OfACentimetre", {.high = 10, .side = 0.01, .share = 0.97}},
                    Named{"TowerOf8Of10M", {.high = 8, .side = 10, .share = 0.97}},
                    Named{"TwinTowerOf8", {.across = 2, .high = 8, .share = 0.97}},
                    Named{"TwoTowersDownTheDip", {.along = 2, .high = 5, .share = 0.97}}),
    name_of);

// 5 s, no more than 1e-3 of a side.
TEST_P(PileStands, UpToTheAngleOfARigidOne) {
  const Pile& pile = GetParam().pile;
  EXPECT_LT(talus::test::farthest(pile, 5), 1e-3 * pile.side);
}

// What lies on a slope beyond it falls.
TEST(Piles, TowerFallsBeyondTheAngleOfARigidOne) {
  for (const int high : {8, 16}) {
    const Pile pile{.high = high, .share = 1.01};
    EXPECT_GT(talus::test::farthest(pile, 12), 0.5) << high;
  }
}

class Sag : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Sides, Sag, testing::Values(10, 1, 0.1, 0.01));

TEST_P(Sag, OfAStackOfTenIsAPartOfItsSide) {
  for (const double step : {0.005, 0.02}) {
    const Pile pile{.high = 10, .side = GetParam(), .share = 0, .step = step};
    EXPECT_LT(talus::test::farthest(pile, 2), 1e-4 * pile.side) << step;
  }
}

// Cubes that touch on all sides, friction 21 degrees on a slope of 20.
TEST(Piles, LatticeHoldsOnASlope) {
  for (const double step : {0.005, 0.02}) {
    Pile pile{.along = 4, .across = 4, .high = 2, .step = step, .friction_deg = 21};
    pile.share = 20 * std::numbers::pi / 180 / std::atan(0.5);
    EXPECT_LT(talus::test::farthest(pile, 3), 1e-3) << step;
  }
}

// Time until a tower of n cubes has turned by 0.2 rad, against a rigid one with the same motion
// from rest: angular acceleration about its foot, by quadrature of the energy.
TEST(Piles, TowerTopplesWhenARigidOneDoes) {
  for (const int high : {8, 24}) {
    const Pile pile{.high = high, .share = 1.05};
    const double exact = talus::test::rigid_topple_time(pile, 0.2);
    EXPECT_NEAR(talus::test::topple_time(pile, 0.2, 1.5 * exact), exact, 0.03 * exact) << high;
  }
}

}  // namespace
