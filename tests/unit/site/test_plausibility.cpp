// Doubts about a site: limits, hints, expected time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "site/plausibility.hpp"

namespace {

using namespace talus;

// A source of 60 x 50 m, 8 m deep, that nothing is odd about.
PlausibilityFacts sound() {
  PlausibilityFacts facts;
  facts.polygon_area = 3000;
  facts.mean_depth = 9;
  facts.max_depth = 12;
  facts.relief = 60;
  facts.normal_depth = 6;
  facts.width = 50;
  facts.terrain_area = 1e6;
  facts.cell_size = 5;
  facts.smallest_spacing = 6;
  facts.n_blocks = 200;
  facts.step_at_foot = 1;
  facts.step_share = 0.1;
  facts.sliding_spacing = 6;
  facts.duration = 60;
  facts.travel_duration = 40;
  facts.moved_share = 0.95;
  facts.left_share = 0;
  facts.largest_rock = 2;
  facts.frequency_key = "hazard.class.all.frequency_per_a";
  facts.frequency = 0.01;
  facts.fences = {{"fence.net", 5, 3000}};
  return facts;
}

std::vector<Doubt> with(double PlausibilityFacts::*field, double value) {
  PlausibilityFacts facts = sound();
  facts.*field = value;
  return doubts_of(facts);
}

}  // namespace

TEST(Plausibility, SoundSourceLeavesNoDoubt) {
  EXPECT_TRUE(doubts_of(sound()).empty());
  EXPECT_TRUE(doubts_of({}).empty());  // nothing is known: nothing is said
}

TEST(Plausibility, EachLimitHasItsDoubtAndItsKey) {
  using F = PlausibilityFacts;
  const struct {
    double F::*field;
    double odd, absurd;  // 0: nothing is refused
    const char* key;
  } limits[] = {{&F::mean_depth, 14, 60, "source.depth_m"},
                {&F::max_depth, 35, 80, "source.depth_m"},
                {&F::normal_depth, 4, 1.5, "source.failure_surface"},
                {&F::width, 40, 12, "terrain.cell_size_m"},
                {&F::cell_size, 6.1, 0, "terrain.cell_size_m"},
                {&F::terrain_area, 9000, 0, "terrain"},
                {&F::n_blocks, 1500, 0, "joints.spacing_m"},
                {&F::step_at_foot, 2.5, 0, "source.failure_surface"},
                {&F::left_share, 0.1, 0, "terrain"},
                {&F::largest_rock, 5000, 2e5, "rockfall"},
                {&F::frequency, 12, 1000, "hazard.class.all.frequency_per_a"},
                {&F::moved_share, 0.5, 0, "source.failure_surface"},
                {&F::duration, 30, 0, "solver.duration_s"}};
  for (const auto& [field, odd, absurd, key] : limits) {
    const std::vector<Doubt> doubts = with(field, odd);
    ASSERT_FALSE(doubts.empty()) << key << " " << odd;
    EXPECT_TRUE(std::any_of(doubts.begin(), doubts.end(), [&wanted = key](const Doubt& doubt) {
      return doubt.what == wanted;
    })) << key;
    for (const Doubt& doubt : doubts) {
      EXPECT_EQ(doubt.state, DoubtState::in_doubt) << doubt.found;
      EXPECT_FALSE(doubt.found.empty() || doubt.hint.empty());
    }
    if (absurd == 0) continue;
    const std::vector<Doubt> refused = with(field, absurd);
    EXPECT_TRUE(std::any_of(refused.begin(), refused.end(),
                            [](const Doubt& doubt) { return doubt.state == DoubtState::refused; }))
        << key << " " << absurd;
  }
}

TEST(Plausibility, FencesThatNobodyBuildsAreDoubted) {
  PlausibilityFacts facts = sound();
  facts.fences = {{"fence.low", 5, 3000}, {"fence.high", 30, 8000}, {"fence.strong", 8, 3e6}};
  const std::vector<Doubt> doubts = doubts_of(facts);
  ASSERT_EQ(doubts.size(), 2u);
  EXPECT_EQ(doubts[0].what, "fence.high.height_m");
  EXPECT_EQ(doubts[0].state, DoubtState::in_doubt);
  EXPECT_EQ(doubts[1].what, "fence.strong.capacity_kj");
  EXPECT_EQ(doubts[1].state, DoubtState::refused);
}

// 800 m for 8 m on a slope of 60 m relief.
TEST(Plausibility, DepthBeyondTheReliefIsRefused) {
  PlausibilityFacts facts = sound();
  facts.mean_depth = facts.max_depth = 800;
  const std::vector<Doubt> doubts = doubts_of(facts);
  ASSERT_GE(doubts.size(), 2u);
  EXPECT_EQ(doubts[0].state, DoubtState::refused);
  EXPECT_EQ(doubts[1].state, DoubtState::refused);
  EXPECT_NE(doubts[1].found.find("800 m deep"), std::string::npos);
}

// A hint does not name settings that the site file has already.
TEST(Plausibility, HintsKnowTheFailureSurface) {
  PlausibilityFacts facts = sound();
  facts.step_at_foot = 5;
  EXPECT_NE(doubts_of(facts).at(0).hint.find("\"daylighting\""), std::string::npos);
  facts.daylights = true;
  EXPECT_EQ(doubts_of(facts).at(0).hint.find("\"daylighting\""), std::string::npos);
  facts = sound();
  facts.mean_depth = 800;
  facts.depth_key = "source.plane_point_m";
  EXPECT_EQ(doubts_of(facts).at(0).what, "source.plane_point_m");
}

TEST(Plausibility, OutlookHasThreeClasses) {
  EXPECT_EQ(outlook_of(0.05), Outlook::stands);
  EXPECT_EQ(outlook_of(0.1), Outlook::goes_in_part);
  EXPECT_EQ(outlook_of(0.9), Outlook::goes_in_part);
  EXPECT_EQ(outlook_of(0.95), Outlook::goes);
  EXPECT_NE(with(&PlausibilityFacts::moved_share, 0.05)[0].found.find("not a rockslide"),
            std::string::npos);
}

TEST(ExpectedTime, GrowsWithBlocksAndShorterSteps) {
  for (const auto& [n_blocks, measured] : {std::pair{70, 0.6}, {150, 1.1}, {258, 3.0}}) {
    EXPECT_LT(cpu_s_of_a_packed_second(n_blocks, 0.01), 1.5 * measured) << n_blocks;
    EXPECT_GT(cpu_s_of_a_packed_second(n_blocks, 0.01), measured / 1.5) << n_blocks;
  }
  EXPECT_NEAR(cpu_s_of_a_packed_second(400, 0.005) / cpu_s_of_a_packed_second(400, 0.01), 1.7,
              1e-9);
  // 389 blocks, 60 s: 69 were measured; 431 blocks: 111
  EXPECT_GT(expected_cpu_s(389, 60, 0.005), 69 / 2.5);
  EXPECT_LT(expected_cpu_s(389, 60, 0.005), 69 * 2.5);
  EXPECT_GT(expected_cpu_s(431, 60, 0.005), 111 / 2.5);
  // a probe as quick as expected gives the same time
  EXPECT_NEAR(scaled_cpu_s(3 * cpu_s_of_a_packed_second(400, 0.01), 3, 0.01, 60, 0.005),
              expected_cpu_s(400, 60, 0.005), 1e-9);
}
