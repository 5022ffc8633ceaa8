// The long form of test_piles.cpp: higher towers, and more of them side by side.
#include <gtest/gtest.h>

#include <string>

#include "verify/cases/pile_scenes.hpp"

namespace {

using talus::cases::Pile;

struct Named {
  const char* name;
  Pile pile;
};
std::string name_of(const testing::TestParamInfo<Named>& info) { return info.param.name; }

class PileStandsLong : public testing::TestWithParam<Named> {};
INSTANTIATE_TEST_SUITE_P(
    Piles, PileStandsLong,
    testing::Values(Named{"TowerOf24", {.high = 24, .share = 0.97}},
                    Named{"TowerOf32", {.high = 32, .share = 0.97}},
                    Named{"TowerOf24At20Ms", {.high = 24, .share = 0.93, .step = 0.02}},
                    Named{"TowerOf32At20Ms", {.high = 32, .share = 0.93, .step = 0.02}},
                    Named{"TowerOf10OfACentimetreAt20Ms",
                          {.high = 10, .side = 0.01, .share = 0.93, .step = 0.02}},
                    Named{"FourTowersOf8", {.across = 4, .high = 8, .share = 0.97}},
                    Named{"SixteenTowersOf8", {.along = 4, .across = 4, .high = 8, .share = 0.9}}),
    name_of);

// 20 s, no more than 1e-2 of a side: high towers rock a little.
TEST_P(PileStandsLong, UpToTheAngleOfARigidOne) {
  const Pile& pile = GetParam().pile;
  EXPECT_LT(talus::cases::farthest(pile, 20), 1e-2 * pile.side);
}

TEST(PilesLong, HighTowersFallBeyondTheAngleOfARigidOne) {
  for (const int high : {24, 32})
    EXPECT_GT(talus::cases::farthest({.high = high, .share = 1.01}, 20), 0.5) << high;
}

TEST(PilesLong, TowerOf24TopplesWhenARigidOneDoes) {
  for (const double step : {0.005, 0.02}) {
    const Pile pile{.high = 24, .share = 1.05, .step = step};
    const double exact = talus::cases::rigid_topple_time(pile, 0.2);
    EXPECT_NEAR(talus::cases::topple_time(pile, 0.2, 1.5 * exact), exact, 0.03 * exact) << step;
  }
}

}  // namespace
