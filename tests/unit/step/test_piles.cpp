// Piles stand where rigid ones do: the sag of a contact does not grow with the load above it, with
// the step, or with small blocks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "step/step.hpp"
#include "verify/cases/pile_scenes.hpp"

namespace {

using namespace talus;
using talus::cases::Pile;

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
                    Named{"TowerOf8At20Ms", {.high = 8, .share = 0.93, .step = 0.02}},
                    Named{"TowerOf16At20Ms", {.high = 16, .share = 0.93, .step = 0.02}},
                    Named{"TowerOf10OfACentimetre", {.high = 10, .side = 0.01, .share = 0.97}},
                    Named{"TowerOf10Of10Centimetres", {.high = 10, .side = 0.1, .share = 0.97}},
                    Named{"TowerOf8Of10M", {.high = 8, .side = 10, .share = 0.97}},
                    Named{"TwinTowerOf8", {.across = 2, .high = 8, .share = 0.97}},
                    Named{"TwinTowerOf12", {.across = 2, .high = 12, .share = 0.97}},
                    Named{"TwinTowerOf8At20Ms",
                          {.across = 2, .high = 8, .share = 0.93, .step = 0.02}},
                    Named{"TwoTowersDownTheDip", {.along = 2, .high = 5, .share = 0.97}}),
    name_of);

// 5 s, no more than 1e-3 of a side.
TEST_P(PileStands, UpToTheAngleOfARigidOne) {
  const Pile& pile = GetParam().pile;
  EXPECT_LT(talus::cases::farthest(pile, 5), 1e-3 * pile.side);
}

// Piles on a slope beyond it fall.
TEST(Piles, FallBeyondTheAngleOfARigidOne) {
  for (const Pile& pile :
       {Pile{.high = 8, .share = 1.01}, Pile{.high = 16, .share = 1.01},
        Pile{.across = 2, .high = 8, .share = 1.01}, Pile{.high = 8, .share = 1.01, .step = 0.02}})
    EXPECT_GT(talus::cases::farthest(pile, 12), 0.5) << pile.across << " x " << pile.high;
}

class Sag : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Sides, Sag, testing::Values(10, 1, 0.1, 0.01));

TEST_P(Sag, OfAStackOfTenIsAPartOfItsSide) {
  const Pile pile{.high = 10, .side = GetParam(), .share = 0};
  EXPECT_LT(talus::cases::farthest(pile, 2), 1e-4 * pile.side);
}

// Cubes that touch on all sides, friction 21 degrees on a slope of 20.
TEST(Piles, LatticeHoldsOnASlope) {
  for (const double step : {0.005, 0.02}) {
    Pile pile{.along = 4, .across = 4, .high = 2, .step = step, .friction_deg = 21};
    pile.share = 20 * std::numbers::pi / 180 / std::atan(0.5);
    EXPECT_LT(talus::cases::farthest(pile, 3), 1e-3) << step;
  }
}

// Time until a tower has turned by 0.2 rad, against one rigid column.
TEST(Piles, TowerTopplesWhenARigidOneDoes) {
  for (const double step : {0.005, 0.02}) {
    const Pile pile{.high = 8, .share = 1.05, .step = step};
    const double exact = talus::cases::rigid_topple_time(pile, 0.2);
    EXPECT_NEAR(talus::cases::topple_time(pile, 0.2, 1.5 * exact), exact, 0.01 * exact) << step;
  }
}

// Its centroid is at 5.485 sides, so that it topples from 5.209 degrees.
TEST(Piles, TowerStandsUnderABlockAThousandTimesAsHeavy) {
  for (const double step : {0.005, 0.02}) {
    Pile pile{.high = 6, .share = 0, .step = step, .heavy = 1000};
    pile.share = (step > 0.01 ? 0.93 : 0.97) * std::atan(0.5 / 5.4851) / std::atan(1.0 / 6);
    EXPECT_LT(talus::cases::farthest(pile, 5), 1e-3) << step;
    pile.share *= 1.01 / (step > 0.01 ? 0.93 : 0.97);
    EXPECT_GT(talus::cases::farthest(pile, 12), 0.5) << step;
  }
}

}  // namespace
