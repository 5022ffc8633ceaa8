#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "post/hazard/risk.hpp"
#include "post/paired.hpp"
#include "sampling/normal.hpp"

using namespace talus;

namespace {

// Runs of the seeds 1 to n, last first where `reversed`.
std::vector<RunMember> runs_of(int n, bool reversed = false) {
  std::vector<RunMember> runs(static_cast<std::size_t>(n));
  for (int r = 0; r < n; ++r) {
    RunMember& run = runs[static_cast<std::size_t>(r)];
    run.info.seed = reversed ? n - r : r + 1;
    run.info.seed_draws = true;
    run.n_blocks = 1;
    run.weight = 1;
  }
  return runs;
}

}  // namespace

// 1 to 10 more hits: mean 5.5, standard error sqrt(9.16667 / 10), Student's with 9
// degrees 2.262157.
TEST(Paired, IsStudentsIntervalOfTheMeanDifference) {
  std::vector<BlockWeight> site, variant;
  for (int r = 0; r < 10; ++r) {
    site.push_back({r, 0, 100.0 * r});
    variant.push_back({9 - r, 0, 100.0 * r + r + 1});
  }
  const RunPairs pairs = pairs_of(runs_of(10), runs_of(10, true));
  EXPECT_EQ(pairs.n_runs, 10);
  const PairedDifference d = paired_difference(pairs, site, variant);
  EXPECT_NEAR(d.value, 5.5, 1e-12);
  EXPECT_NEAR(d.site, 450, 1e-12);
  EXPECT_NEAR(d.interval.high - d.value, 2.262157 * std::sqrt(55.0 / 6 / 10), 1e-5);
  EXPECT_NEAR(d.interval.high + d.interval.low, 11, 1e-12);
}

TEST(Paired, RunsThatOneSideLacksDoNotCount) {
  const RunPairs pairs = pairs_of(runs_of(12), runs_of(10));
  EXPECT_EQ(pairs.n_runs, 10);
  const PairedDifference d = paired_difference(pairs, std::vector<BlockWeight>{{11, 0, 5}}, {});
  EXPECT_EQ(d.value, 0);
  EXPECT_TRUE(std::isnan(d.interval.low));
  EXPECT_TRUE(std::isnan(paired_difference(pairs_of(runs_of(9), runs_of(9)),
                                           std::vector<BlockWeight>{{1, 0, 5}, {2, 0, 1}}, {})
                             .interval.low));
}

// Sums of the same amounts in another order differ in their last digits, and by that alone.
TEST(Paired, RoundingIsNoDifference) {
  const RunPairs pairs = pairs_of(runs_of(12), runs_of(12));
  std::vector<BlockWeight> site, variant;
  for (int r = 0; r < 12; ++r)
    for (const double part : {0.1, 0.7 + r, 0.3}) {
      site.push_back({r, 0, part});
      variant.insert(variant.begin(), {r, 0, part * (1 + 4e-16)});
    }
  PairedDifference d = paired_difference(pairs, site, variant);
  EXPECT_NE(d.variant, d.site);
  EXPECT_EQ(d.value, 0);
  EXPECT_EQ(d.n_differ, 0);
  EXPECT_TRUE(std::isnan(d.interval.low));
  variant.push_back({3, 1, 6});
  d = paired_difference(pairs, site, variant);
  EXPECT_NEAR(d.value, 0.5, 1e-12);
  EXPECT_EQ(d.n_differ, 1);  // which says nothing of its scatter
  EXPECT_TRUE(std::isnan(d.interval.low));
  variant.push_back({7, 1, 6});
  d = paired_difference(pairs, site, variant);
  EXPECT_EQ(d.n_differ, 2);
  // by hand: 6, 6 and ten 0 have the mean 1 and the variance (2 x 25 + 10) / 11; one degree
  EXPECT_NEAR(d.interval.high - 1, 12.7062047 * std::sqrt(60.0 / 11 / 12), 1e-5);
}

TEST(Paired, DifferencesThatAreAllAlikeGiveNoInterval) {
  const RunPairs pairs = pairs_of(runs_of(11), runs_of(11));
  std::vector<BlockWeight> site, variant;
  for (int r = 0; r < 11; ++r) {
    site.push_back({r, 0, 22.1 + r});
    variant.push_back({r, 0, 0.1 + r});
  }
  PairedDifference d = paired_difference(pairs, site, variant);
  EXPECT_NEAR(d.value, -22, 1e-12);
  EXPECT_EQ(d.n_differ, 11);
  EXPECT_TRUE(std::isnan(d.interval.low) && std::isnan(d.interval.high));
  variant[4].weight += 1;
  d = paired_difference(pairs, site, variant);
  EXPECT_GT(d.interval.high - d.interval.low, 0.1);
}

// Risks 1 - exp(-x) of x = 0.6 and 0.2: twelve pairs, in each site 0.6 (1.2 in two of them and 0 in
// two), of which six lose all. The interval is that of e^-0.2 v - e^-0.6 s over the pairs.
TEST(Paired, OfACurveIsTheDifferenceOfWhatIsPrinted) {
  const RunPairs pairs = pairs_of(runs_of(12), runs_of(12));
  const std::vector<double> before = {1.2, 1.2, 0, 0, .6, .6, .6, .6, .6, .6, .6, .6},
                            now = {0, 0, 0, 0, 0, 0, 0, 0, .6, .6, .6, .6};
  std::vector<BlockWeight> site, variant;
  double mean = 0, squares = 0;
  const auto tangent = [&](int r) { return std::exp(-0.2) * now[r] - std::exp(-0.6) * before[r]; };
  for (int r = 0; r < 12; ++r) {
    site.push_back({r, 0, before[r]});
    variant.push_back({r, 0, now[r]});
    mean += tangent(r) / 12;
  }
  for (int r = 0; r < 12; ++r) squares += std::pow(tangent(r) - mean, 2);
  const PairedDifference d = paired_difference(pairs, site, variant, risk_curve);
  EXPECT_NEAR(d.site, 1 - std::exp(-0.6), 1e-12);
  EXPECT_NEAR(d.variant, 1 - std::exp(-0.2), 1e-12);
  EXPECT_NEAR(d.value, d.variant - d.site, 1e-12);
  EXPECT_EQ(d.n_differ, 6);
  const double half = 2.5705818 * std::sqrt(squares / 11 / 12);  // five degrees of freedom
  EXPECT_NEAR(d.interval.low, d.value - half, 1e-6);
  EXPECT_NEAR(d.interval.high, d.value + half, 1e-6);
}

// Cases of weights 1 and 3, each of two runs: weights of runs 0.5 and 1.5. A hit in each run of the
// heavy case is 0.75 x 2 / 2 = 0.75 hits a run, also where one of its runs has no pair.
TEST(Paired, CasesKeepTheirShareWhereARunHasNoPair) {
  std::vector<RunMember> site = runs_of(4), variant = runs_of(4);
  for (auto* runs : {&site, &variant})
    for (int r = 0; r < 4; ++r) {
      RunMember& run = (*runs)[static_cast<std::size_t>(r)];
      run.info.case_name = r < 2 ? "light" : "heavy";
      run.info.seed = r % 2;
      run.run_weight = run.weight = r < 2 ? 0.5 : 1.5;
    }
  const std::vector<BlockWeight> hits{{2, 0, 1.5}, {3, 0, 1.5}};
  EXPECT_DOUBLE_EQ(paired_difference(pairs_of(site, variant), hits, {}).site, 0.75);
  variant.pop_back();  // its weights are then those of three runs
  for (RunMember& run : variant)
    run.run_weight = run.weight = run.info.case_name == "light" ? 0.375 : 2.25;
  const RunPairs pairs = pairs_of(site, variant);
  EXPECT_EQ(pairs.n_runs, 3);
  const PairedDifference d = paired_difference(pairs, hits, std::vector<BlockWeight>{{2, 0, 2.25}});
  EXPECT_NEAR(d.site, 0.75, 1e-12);
  EXPECT_NEAR(d.variant, 0.75, 1e-12);
}

// Rocks of twelve release cells in two runs: the cells are the pairs, and one may have gone.
TEST(Paired, PairsReleaseCellsOverAllRuns) {
  std::vector<RunMember> site = runs_of(2), variant = runs_of(2);
  for (auto* runs : {&site, &variant})
    for (RunMember& run : *runs) {
      run.info.independent = true;
      for (int cell = runs == &variant ? 1 : 0; cell < 13; ++cell)
        run.release_cell.push_back(7 * cell);
      run.n_blocks = static_cast<int>(run.release_cell.size());
    }
  const RunPairs pairs = pairs_of(site, variant);
  EXPECT_EQ(pairs.n_pairs, 13);
  // the rocks of the cell 0 alone hit in both runs, and that of the cell 7 in one
  const PairedDifference d = paired_difference(
      pairs, std::vector<BlockWeight>{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, std::vector<BlockWeight>{});
  EXPECT_EQ(d.value, -1.5);
  // by hand: differences of -2, -1 and eleven 0; two of them say something
  const double mean = -3.0 / 13,
               squares = std::pow(-2 - mean, 2) + std::pow(-1 - mean, 2) + 11 * mean * mean;
  EXPECT_NEAR(d.value - d.interval.low, 12.7062047 * std::sqrt(squares / 12 * 13) / 2, 1e-5);
}

// What both sides share is not in the interval: it holds the true difference in 95 of 100 cases.
TEST(Paired, TheIntervalHoldsTheDifferenceAsOftenAsItSays) {
  Random random(7);
  const RunPairs pairs = pairs_of(runs_of(20), runs_of(20));
  int n_held = 0;
  double width = 0;
  constexpr int n = 4000;
  for (int trial = 0; trial < n; ++trial) {
    std::vector<BlockWeight> site, variant;
    for (int r = 0; r < 20; ++r) {
      const double shared = 100 * random.uniform();
      site.push_back({r, 0, shared});
      variant.push_back({r, 0, shared + 2 + random.uniform() + random.uniform() - 1});
    }
    const PairedDifference d = paired_difference(pairs, site, variant);
    n_held += d.interval.low <= 2 && 2 <= d.interval.high;
    width += (d.interval.high - d.interval.low) / n;
  }
  EXPECT_NEAR(static_cast<double>(n_held) / n, 0.95, 0.01);
  EXPECT_LT(width, 0.5);
}
