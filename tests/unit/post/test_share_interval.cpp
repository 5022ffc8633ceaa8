#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "post/share_interval.hpp"

using namespace talus;

namespace {

// Beta(a, b) by gamma variables: Marsaglia and Tsang, boosted for shapes below 1.
double gamma_variable(Random& random, double shape) {
  if (shape < 1) return gamma_variable(random, shape + 1) * std::pow(random.uniform(), 1 / shape);
  const double d = shape - 1.0 / 3, c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = normal_quantile(std::clamp(random.uniform(), 1e-15, 1 - 1e-15));
    const double v = std::pow(1 + c * x, 3);
    if (v > 0 && std::log(random.uniform()) < 0.5 * x * x + d - d * v + d * std::log(v))
      return d * v;
  }
}

// Blocks of a run that came, of `n_blocks`, correlated by `rho` within the run.
int correlated_hits(Random& random, int n_blocks, double share, double rho) {
  const double scale = (1 - rho) / rho;
  const double a = gamma_variable(random, share * scale),
               b = gamma_variable(random, (1 - share) * scale);
  int hits = 0;
  for (int block = 0; block < n_blocks; ++block) hits += random.uniform() < a / (a + b);
  return hits;
}

// Of `n_trials` simulated ensembles, the share whose interval holds the truth.
double coverage(int n_runs, double share, double rho, int n_trials, std::uint64_t seed) {
  constexpr int n_blocks = 30;
  Random random(seed);
  const ShareBasis basis = share_basis(std::vector<double>(n_runs, n_blocks), false);
  int covered = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    std::vector<RunWeight> parts;
    double sum = 0;
    for (int run = 0; run < n_runs; ++run) {
      const int hits = correlated_hits(random, n_blocks, share, rho);
      if (hits > 0) parts.push_back({run, static_cast<double>(hits)});
      sum += hits;
    }
    const Interval i = share_interval(basis, parts, sum / (n_runs * n_blocks));
    covered += i.low <= share && share <= i.high;
  }
  return static_cast<double>(covered) / n_trials;
}

}  // namespace

// Runs of one block are independent trials, however few: Wilson's interval with the effective
// number of runs, here (1 + 2 + 3)^2 / (1 + 4 + 9).
TEST(ShareInterval, IsWilsonsForSingleBlocks) {
  const std::vector<double> released{1, 2, 3};
  const ShareBasis basis = share_basis(released, true);
  const Interval got = share_interval(basis, std::vector<RunWeight>{{1, 2}}, 1.0 / 3);
  const Interval wanted = wilson_interval(1.0 / 3, 36.0 / 14);
  EXPECT_DOUBLE_EQ(got.low, wanted.low);
  EXPECT_DOUBLE_EQ(got.high, wanted.high);
}

// v = n / (n - 1) sum (y - R w)^2 / (sum w)^2 by hand: 5 of 10 runs all, the rest nothing.
TEST(ShareInterval, TakesTheLinearisedVarianceOverRunsElse) {
  const std::vector<double> released(10, 4.0);
  std::vector<RunWeight> parts;
  for (int run = 0; run < 5; ++run) parts.push_back({run, 4});
  const ShareBasis basis = share_basis(released, false);
  const std::vector<RunShare> some(5, {4, 4});
  const ShareSample sample = share_sample(basis.over, some, 0.5);
  EXPECT_NEAR(sample.n_trials, 0.25 / (10.0 / 9 * 10 * 4 / 1600), 1e-12);  // 9: runs less one
  EXPECT_EQ(sample.degrees, 5);
  const Interval got = share_interval(basis, parts, 0.5);
  const double z = normal_quantile(0.975);
  const Interval wanted = wilson_interval(0.5, 9 * std::pow(z / student_quantile(5, 0.975), 2));
  const Interval of_runs = wilson_interval(0.5, 10);  // a share of blocks is within that of runs
  EXPECT_DOUBLE_EQ(got.low, std::max(wanted.low, of_runs.low));
  EXPECT_DOUBLE_EQ(got.high, std::min(wanted.high, of_runs.high));
}

TEST(ShareInterval, IsNoneForFewRunsOfManyBlocks) {
  const std::vector<double> released(least_runs_to_resample - 1, 4.0);
  const ShareBasis basis = share_basis(released, false);
  EXPECT_TRUE(std::isnan(share_interval(basis, std::vector<RunWeight>{{0, 4}}, 0.1).low));
  EXPECT_TRUE(std::isnan(interval_of_none_or_all(basis, true).high));
}

// Ten runs that agree are ten trials, not proof: none, all, and the same part in each.
TEST(ShareInterval, OfRunsThatAgreeCountsRuns) {
  const std::vector<double> released(10, 4.0);
  const ShareBasis basis = share_basis(released, false);
  EXPECT_EQ(interval_of_none_or_all(basis, false).low, 0);
  EXPECT_DOUBLE_EQ(interval_of_none_or_all(basis, false).high, wilson_interval(0, 10).high);
  EXPECT_DOUBLE_EQ(interval_of_none_or_all(basis, true).low, wilson_interval(1, 10).low);
  EXPECT_EQ(interval_of_none_or_all(basis, true).high, 1);
  std::vector<RunWeight> same;
  for (int run = 0; run < 10; ++run) same.push_back({run, 0.1 * 4});
  EXPECT_DOUBLE_EQ(share_interval(basis, same, 0.1).high, wilson_interval(0.1, 10).high);
  EXPECT_DOUBLE_EQ(share_interval(basis, {}, 0).high, wilson_interval(0, 10).high);
}

TEST(RunShareInterval, IsWilsonsOfTheRuns) {
  const auto of = [](int n_hit, int n) {
    return run_share_interval(share_basis(std::vector<double>(n, 7.0), false),
                              static_cast<double>(n_hit) / n);
  };
  EXPECT_NEAR(of(0, 10).high, 0.277533, 5e-7);
  EXPECT_NEAR(of(0, 100).high, 0.036993, 5e-7);
  EXPECT_NEAR(of(0, 10000).high, 0.000384, 5e-7);
  EXPECT_EQ(of(0, 100).low, 0);
  EXPECT_NEAR(of(5, 100).low, 0.021544, 5e-7);
  EXPECT_NEAR(of(5, 100).high, 0.111750, 5e-7);
}

// They do not fail at random: all of them may have reached the place, or none.
TEST(FailedRuns, WidenAShareByTheirOwn) {
  const Interval sure = with_failed({0.10, 0.10}, 0.02);
  EXPECT_NEAR(sure.low, 0.098, 1e-12);
  EXPECT_NEAR(sure.high, 0.118, 1e-12);
}

TEST(TrialsFor, GiveTheHalfWidth) {
  struct Row {
    double share, half;
    int n;
  };
  for (const Row& row : {Row{0.5, 0.05, 381},
                         {0.5, 0.03, 1064},
                         {0.5, 0.01, 9600},
                         {0.1, 0.05, 141},
                         {0.1, 0.03, 388},
                         {0.1, 0.01, 3461},
                         {0.01, 0.05, 43},
                         {0.01, 0.03, 84},
                         {0.01, 0.01, 454}})
    EXPECT_EQ(std::ceil(trials_for(row.share, row.half)), row.n) << row.share << " " << row.half;
}

// 40 runs, R = 0.10, standard deviation 0.04.
TEST(RunsToAdd, FollowFromTheVarianceOfTheRunsThereAre) {
  const double n_trials = 0.09 / (0.04 * 0.04);
  EXPECT_NEAR(n_trials, 56.25, 1e-9);
  const Interval now = wilson_interval(0.1, n_trials);
  EXPECT_NEAR((now.high - now.low) / 2, 0.080, 5e-4);
  EXPECT_EQ(runs_to_add(40, n_trials, 0.1, 0.05), 61);
  EXPECT_EQ(runs_to_add(40, n_trials, 0.1, 0.03), 236);
  EXPECT_EQ(runs_to_add(40, n_trials, 0.1, 0.02), 578);
  EXPECT_EQ(runs_to_add(40, n_trials, 0.1, 0.09), 0);
}

// Common and rare places, blocks of a run hardly and strongly correlated. 95 % is claimed; the
// error of 1,500 ensembles is 0.6 %.
TEST(ShareInterval, HoldsTheTruthInSimulatedEnsembles) {
  std::uint64_t seed = 0;
  for (const double share : {0.01, 0.02, 0.1, 0.3, 0.7})
    for (const double rho : {0.05, 0.2, 0.5})
      EXPECT_GE(coverage(40, share, rho, 1500, ++seed), 0.93) << share << " " << rho;
  for (const double rho : {0.05, 0.2, 0.5})
    EXPECT_GE(coverage(200, 0.1, rho, 500, ++seed), 0.93) << rho;
}
