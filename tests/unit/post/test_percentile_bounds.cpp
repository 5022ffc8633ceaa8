// Bounds of percentiles over runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "post/percentile_bounds.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

struct RunValue {
  double value = 0;
  BlockWeight run;
};

// Values of runs that each have their own level: the blocks of a run are not independent.
std::vector<RunValue> clustered(Random& random, int n_runs, int n_blocks) {
  std::vector<RunValue> values;
  for (int run = 0; run < n_runs; ++run) {
    const double level = normal_quantile(random.uniform());
    for (int i = 0; i < n_blocks; ++i)
      values.push_back({level + normal_quantile(random.uniform()), {run, i, 1}});
  }
  std::sort(values.begin(), values.end(),
            [](const RunValue& a, const RunValue& b) { return a.value < b.value; });
  return values;
}

std::vector<BlockWeight> runs_of(const std::vector<RunValue>& values) {
  std::vector<BlockWeight> runs;
  for (const RunValue& v : values) runs.push_back(v.run);
  return runs;
}

Clusters equal_runs(int n) {
  return clusters_of_runs(std::vector<double>(static_cast<std::size_t>(n), 1), 2);
}

}  // namespace

TEST(PercentileBounds, AreRanksWhereNoRunRepeats) {
  std::vector<BlockWeight> ascending;
  for (int run = 0; run < 100; ++run) ascending.push_back({run, 0, 2});
  const Clusters clusters = equal_runs(100);
  PercentileBounds bounds{clusters, 200};
  const BoundPlaces places = upper_bound_places(bounds, ascending);
  for (std::size_t k = 0; k < places.size(); ++k)
    EXPECT_EQ(places[k], upper_bound_rank(100, percentile_levels[k].p) - 1);
  EXPECT_EQ(places.back(), -1);
}

TEST(PercentileBounds, NeedTenRunsWhereRunsRepeat) {
  Random random(3);
  for (const int n_runs : {9, 10, 29, 30}) {
    const Clusters clusters = equal_runs(n_runs);
    PercentileBounds bounds{clusters, 200};
    const BoundPlaces places = upper_bound_places(bounds, runs_of(clustered(random, n_runs, 30)));
    EXPECT_EQ(places[0] >= 0, n_runs >= 10) << n_runs;
    EXPECT_EQ(bounds.resamples.has_value(), n_runs >= 10 && n_runs < 30) << n_runs;
  }
}

// The upper end of the interval of F at the percentile, by hand: each of 40 runs has one small and
// one large value, so that F is the same in all and each run is a trial.
TEST(PercentileBounds, ReadTheIntervalOffTheValues) {
  std::vector<BlockWeight> ascending;
  for (int half = 0; half < 2; ++half)
    for (int run = 0; run < 40; ++run) ascending.push_back({run, half, 1});
  const Clusters clusters = equal_runs(40);
  PercentileBounds bounds{clusters, 200};
  const double high = wilson_interval(0.5, 40, normal_quantile(0.95)).high;
  EXPECT_EQ(upper_bound_places(bounds, ascending)[0], static_cast<int>(std::ceil(80 * high)) - 1);
}

// Both values of a run are the same: 80 values are 40 trials, too few for a bound of p95.
TEST(PercentileBounds, CountRunsWhereTheirValuesAgree) {
  std::vector<BlockWeight> ascending;
  for (int i = 0; i < 80; ++i) ascending.push_back({i / 2, i % 2, 1});
  const Clusters clusters = equal_runs(40);
  PercentileBounds bounds{clusters, 200};
  EXPECT_GE(upper_bound_places(bounds, ascending)[1], 0);
  EXPECT_EQ(upper_bound_places(bounds, ascending)[2], -1);
}

// Sums of a level and a deviation, both standard normal: the true percentile is known.
TEST(PercentileBounds, HoldTheTruthInSimulatedEnsembles) {
  Random random(11);
  const double truth = std::sqrt(2.0) * normal_quantile(0.95);
  constexpr int n_trials = 400;
  const Clusters clusters = equal_runs(100);
  PercentileBounds bounds{clusters, 200};
  int both = 0, upper = 0, independent = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    const std::vector<RunValue> values = clustered(random, 100, 20);
    const std::vector<BlockWeight> runs = runs_of(values);
    const BoundedPlaces places = percentile_places(bounds, runs, 0.95);
    both += values[places.low].value <= truth && truth <= values[places.high].value;
    upper += truth <= values[upper_bound_places(bounds, runs)[2]].value;
    const RankInterval ranks = rank_interval(2000, 0.95);
    independent += values[ranks.low - 1].value <= truth && truth <= values[ranks.high - 1].value;
  }
  EXPECT_GE(both, 0.93 * n_trials);
  EXPECT_GE(upper, 0.93 * n_trials);
  EXPECT_LE(independent, 0.85 * n_trials);
}
