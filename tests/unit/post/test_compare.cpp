// Differences of shares between two sets of runs.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "post/maps/compare.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

// `n_runs` runs of one block, each of which comes over cell 7 with probability `share` at a speed
// of `speed` (1 + u).
struct Made {
  CellRows cells;
  ShareBasis basis;
};
Made runs_over(int n_runs, double share, double speed, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::vector<MapRow>> rows(n_runs);
  for (auto& of_run : rows) {
    if (random.uniform() >= share) continue;
    MapRow row;
    row.cell = 7;
    row.largest.speed = static_cast<float>(speed * (1 + random.uniform()));
    of_run.push_back(row);
  }
  Made made;
  made.cells = group_by_cell(std::move(rows), 20);
  made.basis = share_basis(clusters_of_runs(std::vector<double>(n_runs, 1), 1));
  return made;
}

std::size_t band_of(const MapLayer& layer, const std::string& name) {
  for (std::size_t b = 0; b < layer.bands.size(); ++b)
    if (layer.bands[b].name == name) return b;
  throw std::runtime_error("no band " + name);
}

}  // namespace

// Newcombe (1998), table II, method 10: 56/70 - 48/80 is 0.2, 0.0524 to 0.3339.
TEST(Difference, HasThePublishedInterval) {
  const auto estimate = [](double hits, double n) {
    const Interval i = wilson_interval(hits / n, n);
    return Estimate{hits / n, i.low, i.high};
  };
  const Difference d = difference(estimate(48, 80), estimate(56, 70));
  EXPECT_NEAR(d.value, 0.2, 1e-12);
  EXPECT_NEAR(d.low, 0.0524, 5e-5);
  EXPECT_NEAR(d.high, 0.3339, 5e-5);
}

TEST(ComparisonLayer, HoldsTheTrueDifference) {
  int reach = 0, speed = 0;
  constexpr int n_trials = 200;
  for (int trial = 0; trial < n_trials; ++trial) {
    const Made a = runs_over(150, 0.5, 10, 2 * trial), b = runs_over(200, 0.7, 12, 2 * trial + 1);
    const MapLayer layer = comparison_layer({a.cells, a.basis}, {b.cells, b.basis});
    ASSERT_EQ(layer.cell, std::vector<std::uint32_t>{7});
    const auto holds = [&](const std::string& name, double truth) {
      const std::size_t band = band_of(layer, name);
      return layer.bands[band + 1].value[0] <= truth && truth <= layer.bands[band + 2].value[0];
    };
    reach += holds("reach_probability_difference", 0.2);
    speed += holds("velocity_p50_difference", 3);  // 18 - 15 m/s
  }
  EXPECT_GE(reach, 0.92 * n_trials);
  EXPECT_GE(speed, 0.92 * n_trials);
}

// Where nothing of one side came, its reach is 0, with the bound that it has there, and a
// percentile to compare is missing.
TEST(ComparisonLayer, OfACellThatOneSideNeverReached) {
  const Made a = runs_over(100, 0, 10, 1), b = runs_over(100, 0.6, 10, 2);
  const MapLayer layer = comparison_layer({a.cells, a.basis}, {b.cells, b.basis});
  const double share = layer.bands[0].value[0];
  EXPECT_NEAR(share, 0.6, 0.15);
  const Interval i = wilson_interval(share, 100);
  EXPECT_NEAR(layer.bands[1].value[0], share - std::hypot(share - i.low, 0.036993), 1e-5);
  EXPECT_TRUE(std::isnan(layer.bands[band_of(layer, "velocity_p50_difference")].value[0]));
}

// Two sources of one rock each a run, of which the measure takes one out; that of the other crosses
// the cell as before. By hand the difference is 1/2 - 1/2 of the rocks that the site releases.
TEST(ComparisonLayer, OfRocksThatAreTakenOutLeavesTheOthers) {
  constexpr int n = 20;
  std::vector<RunMember> members(n);
  std::vector<std::vector<MapRow>> rows(n);
  for (int r = 0; r < n; ++r) {
    members[r].info.seed = r + 1;
    members[r].info.seed_draws = true;
    members[r].n_blocks = 1;
    members[r].weight = 1;
    MapRow row;
    row.cell = 7;
    rows[r].push_back(row);
  }
  const CellRows a = group_by_cell(rows, 20), b = group_by_cell(rows, 20);
  const ShareBasis two = share_basis(clusters_of_runs(std::vector<double>(n, 2), 2)),
                   one = share_basis(clusters_of_runs(std::vector<double>(n, 1), 1));
  const MapLayer layer = comparison_layer({a, two}, {b, one}, pairs_of(members, members));
  EXPECT_NEAR(layer.bands[0].value[0], 0, 1e-7);
}

// Runs of the same seeds: what both share is not in the interval of reach, which is that of the
// mean of the differences: -1 in 20 of 200 pairs.
TEST(ComparisonLayer, OfPairsIsStudents) {
  constexpr int n = 200;
  std::vector<RunMember> members(n);
  std::vector<std::vector<MapRow>> rows_a(n), rows_b(n);
  for (int r = 0; r < n; ++r) {
    members[r].info.seed = r + 1;
    members[r].info.seed_draws = true;
    members[r].n_blocks = 1;
    members[r].weight = 1;
    MapRow row;
    row.cell = 7;
    if (r < 100) rows_a[r].push_back(row);
    if (r < 80) rows_b[r].push_back(row);
  }
  const CellRows a = group_by_cell(std::move(rows_a), 20), b = group_by_cell(std::move(rows_b), 20);
  const ShareBasis basis = share_basis(clusters_of_runs(std::vector<double>(n, 1), 1));
  const RunPairs pairs = pairs_of(members, members);
  const MapLayer paired = comparison_layer({a, basis}, {b, basis}, pairs);
  const MapLayer alone = comparison_layer({a, basis}, {b, basis});
  EXPECT_NEAR(paired.bands[0].value[0], -0.1, 1e-6);
  const double half = 2.0930241 * std::sqrt(0.1 * 0.9 / (n - 1));  // 19 degrees of freedom
  EXPECT_NEAR(paired.bands[1].value[0], -0.1 - half, 1e-6);
  EXPECT_NEAR(paired.bands[2].value[0], -0.1 + half, 1e-6);
  EXPECT_LT(alone.bands[1].value[0], paired.bands[1].value[0]);
}
