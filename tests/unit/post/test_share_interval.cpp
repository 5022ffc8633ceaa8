#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "post/share_interval.hpp"

using namespace talus;

// Runs of one block are independent trials, however few: Wilson's interval with the effective
// number of runs, here (1 + 2 + 3)^2 / (1 + 4 + 9).
TEST(ShareInterval, IsWilsonsForSingleBlocks) {
  const std::vector<double> released{1, 2, 3};
  const ShareBasis basis = share_basis(released, true, 200, 1);
  const Interval got = share_interval(basis, std::vector<RunWeight>{{1, 2}}, 1.0 / 3);
  const Interval wanted = wilson_interval(1.0 / 3, 36.0 / 14);
  EXPECT_DOUBLE_EQ(got.low, wanted.low);
  EXPECT_DOUBLE_EQ(got.high, wanted.high);
}

TEST(ShareInterval, IsOfTheBootstrapOverRunsElse) {
  const std::vector<double> released(least_runs_to_resample, 4.0);
  std::vector<RunWeight> parts;
  for (int run = 0; run < 5; ++run) parts.push_back({run, 4});
  const ShareBasis basis = share_basis(released, false, 200, 7);
  const Interval got = share_interval(basis, parts, 0.5);
  const RunResamples resamples = resample_runs(least_runs_to_resample, 200, 7);
  const Interval wanted = bootstrap_share(parts, resampled_sums(resamples, released), resamples);
  EXPECT_EQ(got.low, wanted.low);
  EXPECT_EQ(got.high, wanted.high);
}

TEST(ShareInterval, IsNoneForFewRunsOfManyBlocks) {
  const std::vector<double> released(least_runs_to_resample - 1, 4.0);
  const ShareBasis basis = share_basis(released, false, 200, 1);
  EXPECT_TRUE(std::isnan(share_interval(basis, std::vector<RunWeight>{{0, 4}}, 0.1).low));
  EXPECT_TRUE(std::isnan(interval_of_none_or_all(basis, true).high));
}

// Ten runs that agree are ten trials, not proof.
TEST(ShareInterval, OfNoneOrAllCountsRuns) {
  const std::vector<double> released(least_runs_to_resample, 4.0);
  const ShareBasis basis = share_basis(released, false, 200, 1);
  EXPECT_EQ(interval_of_none_or_all(basis, false).low, 0);
  EXPECT_DOUBLE_EQ(interval_of_none_or_all(basis, false).high, wilson_interval(0, 10).high);
  EXPECT_DOUBLE_EQ(interval_of_none_or_all(basis, true).low, wilson_interval(1, 10).low);
  EXPECT_EQ(interval_of_none_or_all(basis, true).high, 1);
}
