// Observed events against computed ones.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "post/observed/observed.hpp"
#include "run_maker.hpp"

namespace {

using namespace talus;           // NOLINT: a test
using namespace talus::testing;  // NOLINT: a test

const Vec2 unknown = Vec2::Constant(std::nan(""));  // start

// One block a run, which goes from (0, 0) as far as `runout` says along x, `across` to its left.
Computed computed_of(const std::vector<double>& runout, const std::vector<double>& across = {}) {
  Computed computed;
  for (std::size_t r = 0; r < runout.size(); ++r)
    computed.blocks.push_back({static_cast<int>(r), 0, 1, Vec2(0, 0),
                               Vec2(runout[r], across.empty() ? 0 : across[r]), 1.0 + r, true,
                               false});
  finish(computed);
  return computed;
}

ShareBasis basis_of(std::size_t n_runs) {
  return share_basis(clusters_of_runs(std::vector<double>(n_runs, 1), 1));
}

std::vector<double> upto(int n) {
  std::vector<double> values;
  for (int k = 1; k <= n; ++k) values.push_back(k);
  return values;
}

ObservedEvent boulders_at(const std::vector<Vec2>& places) {
  ObservedEvent event;
  event.name = "event";
  for (const Vec2& place : places) event.boulders.push_back({place, std::nan(""), unknown, ""});
  return event;
}

std::vector<WeightedValue> sorted_values(std::vector<WeightedValue> values) {
  sort_values(values);
  return values;
}

}  // namespace

// Starts are weighed; the direction is that of the mean observed displacement.
TEST(Observed, AlongIsTheMeanDirectionOfTheBouldersFromTheMeanStart) {
  Computed computed;
  computed.blocks = {{0, 0, 3, Vec2(0, 0), Vec2(9, 9), 1, true, false},
                     {0, 1, 1, Vec2(4, 8), Vec2(9, 9), 1, true, false}};
  finish(computed);
  const RunoutAxis axis = runout_axis(computed, boulders_at({{1, 12}, {1, 22}}).boulders);
  EXPECT_EQ(axis.start, Vec2(1, 2));
  EXPECT_EQ(axis.along, Vec2(0, 1));
  const AlongAcross at =
      along_and_across(axis, ObservedPoint{Vec2(-2, 6), 1, unknown, ""});  // 4 ahead, 3 to the left
  EXPECT_DOUBLE_EQ(at.runout, 5);
  EXPECT_DOUBLE_EQ(at.across, 3);
}

// As tests/studies/field.py measures: displacements scatter, starts do not.
TEST(Observed, WhereStartsAreKnownEachDisplacementHasItsOwn) {
  Computed computed;
  computed.blocks = {{0, 0, 1, Vec2(0, 0), Vec2(10, 1), 1, true, false},
                     {1, 0, 1, Vec2(0, 40), Vec2(10, 39), 1, true, false}};
  finish(computed);
  ObservedEvent event;
  event.name = "event";
  event.boulders = {{Vec2(8, 2), std::nan(""), Vec2(0, 0), ""},
                    {Vec2(8, 38), std::nan(""), Vec2(0, 40), ""}};
  const ShareBasis basis = share_basis(clusters_of_runs({1, 1}, 1));
  const BoulderScore own = *score_of(event, 0, computed, basis).boulders;
  EXPECT_TRUE(own.axis.has_starts);
  EXPECT_EQ(own.axis.along, Vec2(1, 0));
  EXPECT_NEAR(own.mean.observed, std::hypot(8, 2), 1e-12);
  EXPECT_NEAR(own.mean.computed, std::hypot(10, 1), 1e-12);
  EXPECT_NEAR(own.across.observed, 2, 1e-12);
  EXPECT_NEAR(own.across.computed, 1, 1e-12);
  for (ObservedPoint& boulder : event.boulders) boulder.start = unknown;
  EXPECT_NEAR(score_of(event, 0, computed, basis).boulders->across.computed, 19, 1e-12);
}

TEST(Observed, AreaBetweenDistributionsIsTheMeanShift) {
  const auto area = [](std::vector<WeightedValue> a, std::vector<WeightedValue> b) {
    return area_between(sorted_values(std::move(a)), sorted_values(std::move(b)));
  };
  EXPECT_DOUBLE_EQ(area({{0, 1}}, {{1, 5}}), 1);
  EXPECT_DOUBLE_EQ(area({{0, 1}, {2, 1}}, {{1, 1}}), 1);
  EXPECT_DOUBLE_EQ(area({{0, 1}, {2, 3}}, {{0, 2}, {2, 2}}), 0.5);  // a quarter moves by 2
  EXPECT_DOUBLE_EQ(area({{3, 1}, {5, 2}}, {{5, 4}, {3, 2}}), 0);
  EXPECT_TRUE(std::isnan(area({}, {{1, 1}})));
  // by brute force over a fine grid
  Random random(3);
  std::vector<WeightedValue> a, b;
  for (int k = 0; k < 7; ++k) a.push_back({random.uniform(), random.uniform()});
  for (int k = 0; k < 4; ++k) b.push_back({random.uniform(), random.uniform()});
  const auto below = [](const std::vector<WeightedValue>& values, double x) {
    double part = 0, whole = 0;
    for (const WeightedValue& v : values) whole += v.weight, part += v.value <= x ? v.weight : 0;
    return part / whole;
  };
  constexpr int n = 200000;
  double sum = 0;
  for (int k = 0; k < n; ++k)
    sum += std::abs(below(a, (k + 0.5) / n) - below(b, (k + 0.5) / n)) / n;
  EXPECT_NEAR(area(a, b), sum, 1e-4);
}

// Of run-outs of 1, 2 ... 100 m a quarter is not longer than 25.5 m; each run is a trial.
TEST(Observed, PercentileOfABoulderIsTheShareOfRunoutsBelowWithItsInterval) {
  const Computed computed = computed_of(upto(100));
  const EventScore score = score_of(boulders_at({{25.5, 0}}), 0, computed, basis_of(100));
  ASSERT_TRUE(score.boulders);
  EXPECT_FALSE(score.scars || score.outline);
  const BoulderRow& row = score.boulders->rows.at(0);
  EXPECT_DOUBLE_EQ(row.percentile.share, 0.25);
  const Interval wilson = wilson_interval(0.25, 100);
  EXPECT_DOUBLE_EQ(row.percentile.interval.low, wilson.low);
  EXPECT_DOUBLE_EQ(row.percentile.interval.high, wilson.high);
  EXPECT_DOUBLE_EQ(score.boulders->mean.computed, 50.5);
  EXPECT_DOUBLE_EQ(score.boulders->levels[1].computed, 50);
}

// Two blocks of one run that share a fate are one trial, not two; nine runs of two give no
// interval.
TEST(Observed, BlocksOfOneRunAreNoTrialsOfTheirOwn) {
  const auto interval = [](int n_runs, int n_blocks) {
    Computed computed;
    for (int r = 0; r < n_runs; ++r)
      for (int b = 0; b < n_blocks; ++b)
        computed.blocks.push_back({r, b, 1, Vec2(0, 0), Vec2(r + 1, 0), 1, true, false});
    finish(computed);
    const ShareBasis basis = share_basis(clusters_of_runs(
        std::vector<double>(static_cast<std::size_t>(n_runs), n_blocks), n_blocks));
    return score_of(boulders_at({{n_runs / 4 + 0.5, 0}}), 0, computed, basis)
        .boulders->rows[0]
        .percentile.interval;
  };
  EXPECT_NEAR(interval(40, 2).low, interval(40, 4).low, 1e-12);
  EXPECT_NEAR(interval(40, 2).high, interval(40, 4).high, 1e-12);
  EXPECT_TRUE(std::isnan(interval(9, 2).low));
}

// Blocks of a mass that stayed are not part of the whole.
TEST(Observed, WhatDidNotMoveIsNoPartOfTheWhole) {
  Computed computed = computed_of(upto(100));
  const ShareBasis released = share_basis(clusters_of_runs(std::vector<double>(100, 5), 5));
  const BoulderRow row =
      score_of(boulders_at({{25.5, 0}}), 0, computed, released).boulders->rows.at(0);
  EXPECT_DOUBLE_EQ(row.percentile.share, 0.25);
  EXPECT_DOUBLE_EQ(row.percentile.interval.low, wilson_interval(0.25, 100).low);
}

// 0.5^n and 0.9^n on each side: 2 * 0.5^6 < 0.05 <= 2 * 0.5^5; 0.9^36 < 0.025 <= 0.9^35.
TEST(Observed, OrderStatisticsSayWhatFewPointsCannotTell) {
  EXPECT_EQ(points_needed(0.5), 6);
  EXPECT_EQ(points_needed(0.9), 36);
  EXPECT_EQ(points_needed(0.1), 36);
  const Computed computed = computed_of(upto(100));
  const auto score = [&](int n) {
    std::vector<Vec2> places;
    for (int k = 1; k <= n; ++k) places.emplace_back(k, 0);
    return *score_of(boulders_at(places), 0, computed, basis_of(100)).boulders;
  };
  EXPECT_EQ(what_they_tell(score(4)),
            "n = 4 points cannot tell the median (6 can) nor the 10th and 90th percentiles (36 "
            "can)");
  EXPECT_TRUE(std::isnan(score(5).levels[1].interval.low));
  EXPECT_TRUE(std::isnan(score(5).mean.interval.low));
  const BoulderScore six = score(6);
  EXPECT_EQ(six.levels[1].interval.low, 1);
  EXPECT_EQ(six.levels[1].interval.high, 6);
  EXPECT_EQ(what_they_tell(six),
            "n = 6 points tell the median (1 to 6 m, 95 %), not the 10th and 90th percentiles (36 "
            "can)");
  EXPECT_TRUE(std::isnan(score(35).levels[2].interval.high));
  EXPECT_EQ(score(36).levels[2].interval.high, 36);
}

// Points drawn from the computed distribution are told apart from it once in twenty times, their
// mean percentile lies beyond the range of chance as often; points from elsewhere are told apart.
TEST(Observed, PointsOfTheComputedDistributionAreRarelyToldApart) {
  const Computed computed = computed_of(upto(400));
  const ShareBasis basis = basis_of(400);
  Random random(7);
  constexpr int n_trials = 120;
  int n_apart = 0, n_beyond = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    std::vector<Vec2> places;
    for (int k = 0; k < 12; ++k) places.emplace_back(1.0 + random.below(400), 0);
    const BoulderScore score = *score_of(boulders_at(places), 0, computed, basis).boulders;
    n_apart += score.is_told_apart();
    n_beyond +=
        score.mean_percentile < score.by_chance.low || score.mean_percentile > score.by_chance.high;
  }
  EXPECT_LE(n_apart, n_trials / 8);
  EXPECT_LE(n_beyond, n_trials / 8);
  EXPECT_GE(n_apart + n_beyond, 1);
  std::vector<Vec2> near;
  for (int k = 1; k <= 12; ++k) near.emplace_back(10 * k, 0);
  EXPECT_TRUE(score_of(boulders_at(near), 0, computed, basis).boulders->is_told_apart());
}

// Where all blocks of a run share its draws, an event is one run: points near one another are to be
// expected.
TEST(Observed, PointsOfOneRunMayLieTogether) {
  Computed computed;
  for (int r = 0; r < 20; ++r)
    for (int b = 0; b < 10; ++b)
      computed.blocks.push_back({r, b, 1, Vec2(0, 0), Vec2(10 * r + b, 0), 1, true, false});
  finish(computed);
  const ShareBasis basis = share_basis(clusters_of_runs(std::vector<double>(20, 10), 10));
  const ObservedEvent event = boulders_at({{31, 0}, {33, 0}, {35, 0}, {37, 0}, {39, 0}});
  const BoulderScore of_rocks = *score_of(event, 0, computed, basis).boulders;
  EXPECT_TRUE(of_rocks.is_told_apart());
  EXPECT_NEAR(of_rocks.by_chance.low, 0.5 - 1.96 / std::sqrt(60), 0.03);
  computed.is_event_a_run = true;
  const BoulderScore of_run = *score_of(event, 0, computed, basis).boulders;
  EXPECT_FALSE(of_run.is_told_apart());
  EXPECT_LT(of_run.by_chance.low, 0.05);
}

TEST(Observed, SpreadAcrossIsAStandardDeviation) {
  const Computed computed = computed_of({10, 10, 10, 10}, {-3, -1, 1, 3});
  const EventScore score = score_of(boulders_at({{20, -2}, {20, 2}}), 0, computed, basis_of(4));
  EXPECT_NEAR(score.boulders->across.observed, 2, 1e-12);
  EXPECT_NEAR(score.boulders->across.computed, std::sqrt(5), 1e-12);
}

namespace {

RunFile run_with_passages(const std::vector<Passage>& passages, bool alone) {
  RunFile run;
  run.info.independent = alone;
  run.grid = {{0, 50}, 5, 10, 10};
  for (int b = 0; b < 3; ++b) add_box(run, Vec3(1, 1, 1), Vec3(2, 48, 0));
  add_frame(run, 9, {standing({2, 48, 0}), standing({22, 48, 0}), standing({42, 48, 0})});
  run.phase = {Phase::asleep, Phase::asleep, Phase::left_domain};
  run.passages = passages;
  return run;
}

Passage passage(int block, int cell, float height) {
  Passage out;
  out.block = block;
  out.cell = cell;
  out.largest.centroid_height = height;
  return out;
}

}  // namespace

TEST(Observed, OfAMassWhatMovedCountsAndOfRocksAll) {
  for (const bool alone : {false, true}) {
    Computed computed;
    add_blocks(computed, run_with_passages({}, alone), 0, 0.05);
    EXPECT_EQ(computed.blocks.size(), alone ? 3u : 2u);
    finish(computed);
    EXPECT_DOUBLE_EQ(computed.left_share, alone ? 1.0 / 3 : 0.5);
  }
}

// The scar is held against the centroids that passed its cell; one that nothing passed says so.
TEST(Observed, ScarsStandAmongTheHeightsThatPassedTheirCell) {
  ObservedEvent event;
  event.name = "event";
  event.scars = {{Vec2(7, 47), 1.5, unknown, "2019"}, {Vec2(48, 2), 1, unknown, ""}};
  Computed computed;
  std::vector<Passage> passages = {passage(0, 1, 1), passage(1, 1, 2), passage(2, 1, 3),
                                   passage(1, 2, 1)};
  add_blocks(computed, run_with_passages(passages, true), 0, 0.05);
  add_passages(computed, {event}, run_with_passages(passages, true), 0, passages);
  const EventScore score = score_of(event, 0, computed, share_basis(clusters_of_runs({3}, 3)));
  ASSERT_TRUE(score.scars);
  const ScarRow &hit = score.scars->rows[0], &free = score.scars->rows[1];
  EXPECT_EQ(hit.n_passes, 3);
  EXPECT_NEAR(hit.percentile.share, 1.0 / 3, 1e-12);
  EXPECT_EQ(hit.p50, 2);
  EXPECT_EQ(free.n_passes, 0);
  EXPECT_TRUE(std::isnan(free.percentile.share) && std::isnan(free.p95));
  EXPECT_EQ(score.scars->n_passed, 1);
  EXPECT_NEAR(score.scars->mean_percentile, 1.0 / 3, 1e-12);
  EXPECT_EQ(score.scars->by_chance.low, 0);  // of a single scar
}

// Of the blocks at rest one in two lies in it; blocks passed one of its four cells.
TEST(Observed, OutlineHoldsAShareOfTheDepositAndIsReachedInPart) {
  ObservedEvent event;
  event.name = "event";
  event.outline.rings = {{{20, 40}, {30, 40}, {30, 50}, {20, 50}}};
  event.polygon = {0};
  Computed computed;
  const std::vector<Passage> passages = {passage(1, 4, 1), passage(1, 3, 1)};
  add_blocks(computed, run_with_passages(passages, true), 0, 0.05);
  add_passages(computed, {event}, run_with_passages(passages, true), 0, passages);
  const EventScore score = score_of(event, 0, computed, share_basis(clusters_of_runs({3}, 3)));
  ASSERT_TRUE(score.outline);
  EXPECT_DOUBLE_EQ(score.outline->inside.share, 0.5);
  EXPECT_DOUBLE_EQ(score.outline->reached_share, 0.25);
}
