// Calibration: implausibility of results, and the section that it writes.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "post/observed/calibrate.hpp"
#include "site/site_layers.hpp"

namespace {

using namespace talus;  // NOLINT: a test

ObservedEvent boulders_at(const std::vector<Vec2>& places) {
  ObservedEvent event;
  event.name = "spring";
  for (const Vec2& place : places)
    event.boulders.push_back({place, std::nan(""), Vec2::Constant(std::nan("")), ""});
  return event;
}

void add_run(Computed& computed, int run, const std::vector<Vec2>& ends) {
  for (int b = 0; b < static_cast<int>(ends.size()); ++b)
    computed.blocks.push_back({run, b, 1, Vec2(0, 0), ends[b], 1, true, false});
}

Computed one_run(const std::vector<Vec2>& ends) {
  Computed computed;
  add_run(computed, 0, ends);
  finish(computed);
  return computed;
}

double implausibility(const ObservedEvent& event, ObservedKind kind, const Computed& computed) {
  return implausibility_of(event, 0, kind, computed, 0).value;
}

// Normal, of a mean and a deviation along x, and a deviation of 3 across.
std::vector<Vec2> drawn_ends(Random& random, int n, double mean, double deviation) {
  std::vector<Vec2> ends;
  for (int k = 0; k < n; ++k)
    ends.emplace_back(mean + deviation * random.normal(), 3 * random.normal());
  return ends;
}

}  // namespace

// Run-outs of 9 and 11 m have the variance 2; a boulder's noise and that of two blocks add up.
TEST(Calibrate, ImplausibilityOfAMeanHasTheNoiseOfBoth) {
  const Computed run = one_run({{9, 0}, {11, 0}});
  EXPECT_DOUBLE_EQ(implausibility(boulders_at({{10, 0}}), ObservedKind::boulders, run), 0);
  EXPECT_DOUBLE_EQ(implausibility(boulders_at({{13, 0}}), ObservedKind::boulders, run),
                   3 / std::sqrt(2 * (1 + 0.5)));
  EXPECT_DOUBLE_EQ(implausibility(boulders_at({{12, 0}, {14, 0}}), ObservedKind::boulders, run),
                   3 / std::sqrt(2 * (0.5 + 0.5)));
  // a single block has no scatter to tell it by
  EXPECT_TRUE(std::isnan(
      implausibility(boulders_at({{10, 0}}), ObservedKind::boulders, one_run({{9, 0}}))));
}

// Of a normal distribution the variance of a deviation s is s^2 / (2 n).
TEST(Calibrate, ImplausibilityOfAScatterIsThatOfANormalDistribution) {
  Random random(5);
  const Computed run = one_run(drawn_ends(random, 40000, 100, 10));
  std::vector<Vec2> places;  // deviation 20 along, 3 across, mean as the run's
  for (int k = 0; k < 50; ++k)
    for (const double side : {-1.0, 1.0})
      places.emplace_back(100 + 19.9 * side, 2.985 * (k % 2 == 0 ? side : -side));
  const Implausibility worst =
      implausibility_of(boulders_at(places), 0, ObservedKind::boulders, run, 0);
  EXPECT_STREQ(worst.number, "scatter of the run-out");
  EXPECT_NEAR(worst.value, 10 / (10 / std::sqrt(200)), 0.5);
}

// A scar below one of three blocks has the rank 2 of 4.
TEST(Calibrate, ImplausibilityOfScarsIsThatOfEvenRanks) {
  ObservedEvent event;
  event.scars.resize(2);
  event.scars[0].size = 1.5;
  event.scars[1].size = 1;
  Computed computed = one_run({{10, 0}, {10, 0}, {10, 0}});
  computed.passes = {{{{0, 0, 1, 1}, {0, 1, 1, 2}, {0, 2, 1, 3}}, {}}};
  const double deviation = std::sqrt(15 / (12 * 16.0));
  EXPECT_NEAR(implausibility(event, ObservedKind::scars, computed), 0.125 / deviation, 1e-12);
  event.scars[0].size = 9;
  EXPECT_NEAR(implausibility(event, ObservedKind::scars, computed), 0.375 / deviation, 1e-12);
  computed.passes[0][0].clear();
  EXPECT_TRUE(std::isnan(implausibility(event, ObservedKind::scars, computed)));
}

TEST(Calibrate, AnOutlineThatHoldsHalfOfTheDepositContradictsNothing) {
  ObservedEvent event;
  event.outline.rings = {{{0, -5}, {20, -5}, {20, 5}, {0, 5}}};
  std::vector<Vec2> ends(8, Vec2(10, 0));
  ends.resize(16, Vec2(30, 0));
  EXPECT_EQ(implausibility(event, ObservedKind::outline, one_run(ends)), 0);
  ends.resize(64, Vec2(30, 0));
  EXPECT_DOUBLE_EQ(implausibility(event, ObservedKind::outline, one_run(ends)),
                   (0.5 - 0.125) / (0.5 / 8));
}

// Boulders that were drawn from the run itself contradict it in 2 % of the cases.
TEST(Calibrate, ARunIsRarelyContradictedByItsOwnDistribution) {
  Random random(1);
  constexpr int n_trials = 1000;
  int n_contradicted = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    const ObservedEvent event = boulders_at(drawn_ends(random, 15, 100, 12));
    const Computed run = one_run(drawn_ends(random, 40, 100, 12));
    n_contradicted += implausibility(event, ObservedKind::boulders, run) > most_implausible;
  }
  EXPECT_LE(n_contradicted, n_trials * 5 / 100);
  EXPECT_GE(n_contradicted, 1);
}

// Runs of 33 means between 60 and 140 m: those far from the truth are contradicted, and
// of the boulders that were left out nine in ten lie within the 5th and 95th percentile.
TEST(Calibrate, TheSetLeavesOutWhatIsFarFromTheTruth) {
  Random random(11);
  constexpr int n_trials = 40, n_runs = 33, n_blocks = 40;
  int n_far = 0, n_far_held = 0, n_left_out = 0, n_within = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    const std::vector<ObservedEvent> events = {boulders_at(drawn_ends(random, 15, 100, 12))};
    Computed computed;
    std::vector<std::vector<DrawnKey>> drawn;
    for (int r = 0; r < n_runs; ++r) {
      const double mean = 60 + 2.5 * r;
      add_run(computed, r, drawn_ends(random, n_blocks, mean, 12));
      drawn.push_back({{"q", "ground.a.friction_deg", mean}});
    }
    finish(computed);
    const Calibration found = calibrate(events, computed, drawn);
    for (const JudgedRun& run : found.runs)
      if (std::abs(run.drawn[0] - 100) > 30) ++n_far, n_far_held += run.is_plausible();
    const LeftOutCount count = left_out_count(found);
    n_left_out += count.n, n_within += count.n_within;
    EXPECT_EQ(found.points.size(), 15u);
    EXPECT_TRUE(found.layers.empty());
  }
  EXPECT_LE(n_far_held, n_far / 50);
  EXPECT_NEAR(static_cast<double>(n_within) / n_left_out, 0.9, 0.05);
}

// Two events that contradict each other say so when one of them is left out.
TEST(Calibrate, ALayerThatIsLeftOutIsHeldAgainstWhatTheRestLeaves) {
  Random random(2);
  std::vector<ObservedEvent> events = {boulders_at(drawn_ends(random, 20, 100, 5)),
                                       boulders_at(drawn_ends(random, 20, 150, 5))};
  events[1].name = "autumn";
  Computed computed;
  std::vector<std::vector<DrawnKey>> drawn;
  for (int r = 0; r < 2; ++r) {
    add_run(computed, r, drawn_ends(random, 50, 100 + 50 * r, 5));
    drawn.push_back({{"q", "ground.a.friction_deg", 20.0 + r}, {"s", "joints.J.dip_deg", 3}});
  }
  finish(computed);
  const Calibration found = calibrate(events, computed, drawn);
  EXPECT_EQ(n_plausible(found), 0);
  EXPECT_EQ(section_text(found), "# the observations contradict all runs\n");
  ASSERT_EQ(found.layers.size(), 2u);
  EXPECT_EQ(found.layers[0].n_plausible, 1);
  EXPECT_EQ(found.layers[0].n_contradicted, 1);
  EXPECT_EQ(found.keys, std::vector<std::string>{"ground.a.friction_deg"});  // none of the rock
  EXPECT_NE(text(found).find("the observations do not contradict 0 of 2 runs; least, by "),
            std::string::npos);
}

// The next make draws from the section that was written.
TEST(Calibrate, TheSectionOfTheSetIsDrawnFrom) {
  Calibration found;
  found.keys = {"ground.a.friction_deg", "ground.a.cor"};
  found.runs = {{0, 1, "", {30, 0.25}}, {1, 9, "", {35, 0.5}}, {2, 3, "", {20, 1.0 / 3}}};
  EXPECT_EQ(n_plausible(found), 2);
  Site site = parse_site("[ground.a]\nfriction_deg = 40\n", "s/site.toml");
  take_quantities(site, section_text(found), "s/calibrate.toml");
  site.uncertainty.sample = 1;
  check_uncertainty(site);
  ASSERT_EQ(site.quantities.size(), 1u);
  EXPECT_EQ(site.quantities[0].values, (std::vector<double>{20, 1.0 / 3, 30, 0.25}));
  apply_draws(site, DrawScope::all);
  EXPECT_EQ(site.grounds[0].cor, site.grounds[0].friction_deg == 20 ? 1.0 / 3 : 0.25);
  found.keys.clear();
  EXPECT_EQ(section_text(found), "# nothing was drawn: give [uncertainty.*]\n");
}
