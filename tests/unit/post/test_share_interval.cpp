// Intervals of shares, and the runs to add.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "post/share_interval.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

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
  const ShareBasis basis =
      share_basis(clusters_of_runs(std::vector<double>(n_runs, n_blocks), n_blocks));
  int covered = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    std::vector<BlockWeight> parts;
    double sum = 0;
    for (int run = 0; run < n_runs; ++run) {
      const int hits = correlated_hits(random, n_blocks, share, rho);
      if (hits > 0) parts.push_back({run, 0, static_cast<double>(hits)});
      sum += hits;
    }
    const Interval i = share_interval(basis, parts, sum / (n_runs * n_blocks));
    covered += i.low <= share && share <= i.high;
  }
  return static_cast<double>(covered) / n_trials;
}

// Rocks that fall one by one: `n_each` from each of `n_cells` cells in every run.
std::vector<RunMember> runs_of_cells(int n_runs, int n_cells, int n_each) {
  std::vector<RunMember> runs(static_cast<std::size_t>(n_runs));
  for (RunMember& run : runs) {
    run.info.independent = true;
    for (int cell = 0; cell < n_cells; ++cell)
      run.release_cell.insert(run.release_cell.end(), static_cast<std::size_t>(n_each), cell);
    run.n_blocks = n_cells * n_each;
    run.weight = run.n_blocks;
  }
  return runs;
}

// Rocks of all runs that come. Those of a cell have the same probability in every run, for they
// fall over the same ground: Beta distributed over cells, so that two rocks of one cell have the
// correlation `rho`.
std::vector<BlockWeight> rocks_that_come(Random& random, const std::vector<RunMember>& runs,
                                         int n_cells, double share, double rho) {
  const double scale = (1 - rho) / rho;
  std::vector<double> chance;
  for (int cell = 0; cell < n_cells; ++cell) {
    const double a = gamma_variable(random, share * scale),
                 b = gamma_variable(random, (1 - share) * scale);
    chance.push_back(a / (a + b));
  }
  std::vector<BlockWeight> rocks;
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (int b = 0; b < runs[r].n_blocks; ++b)
      if (random.uniform() < chance[runs[r].release_cell[b]])
        rocks.push_back({static_cast<int>(r), b, 1});
  return rocks;
}

// Of simulated ensembles of rocks, how often intervals hold the truth: those over release cells, 95
// and 90 %, and those over runs, or with each rock a trial of its own.
struct CellCoverage {
  double cells = 0, cells_90 = 0, runs = 0, rocks = 0;
};
CellCoverage cell_coverage(int n_runs, int n_cells, int n_each, double share, double rho,
                           int n_trials, std::uint64_t seed) {
  Random random(seed);
  std::vector<RunMember> runs = runs_of_cells(n_runs, n_cells, n_each);
  const ShareBasis over_cells = share_basis(clusters_of(runs));
  for (RunMember& run : runs) run.draws_for_all = true;
  const ShareBasis over_runs = share_basis(clusters_of(runs));
  CellCoverage out;
  for (int trial = 0; trial < n_trials; ++trial) {
    const std::vector<BlockWeight> rocks = rocks_that_come(random, runs, n_cells, share, rho);
    const double n = over_cells.over.whole, found = static_cast<double>(rocks.size()) / n;
    const auto holds = [&](const Interval& i) {
      return (i.low <= share && share <= i.high ? 1.0 : 0.0) / n_trials;
    };
    out.cells += holds(share_interval(over_cells, rocks, found));
    out.runs += holds(share_interval(over_runs, rocks, found));
    out.rocks += holds(wilson_interval(found, n));
    std::vector<ClusterShare> by_cell(static_cast<std::size_t>(n_cells));
    for (const BlockWeight& rock : rocks) ++by_cell[runs[rock.run].release_cell[rock.block]].part;
    for (ClusterShare& cell : by_cell) cell.whole = over_cells.clusters.weight[0];
    std::erase_if(by_cell, [](const ClusterShare& cell) { return cell.part == 0; });
    out.cells_90 +=
        holds(sample_interval(share_sample(over_cells.over, by_cell, found), found, 0.95));
  }
  return out;
}

}  // namespace

// Runs of one block are independent trials, however few: Wilson's interval with the effective
// number of runs, here (1 + 2 + 3)^2 / (1 + 4 + 9).
TEST(ShareInterval, IsWilsonsForSingleBlocks) {
  const std::vector<double> released{1, 2, 3};
  const ShareBasis basis = share_basis(clusters_of_runs(released, 1));
  const Interval got = share_interval(basis, std::vector<BlockWeight>{{1, 0, 2}}, 1.0 / 3);
  const Interval wanted = wilson_interval(1.0 / 3, 36.0 / 14);
  EXPECT_DOUBLE_EQ(got.low, wanted.low);
  EXPECT_DOUBLE_EQ(got.high, wanted.high);
}

// v = n / (n - 1) sum (y - R w)^2 / (sum w)^2 by hand: 5 of 10 runs all, the rest nothing.
TEST(ShareInterval, TakesTheLinearisedVarianceOverRunsElse) {
  const std::vector<double> released(10, 4.0);
  std::vector<BlockWeight> parts;
  for (int run = 0; run < 5; ++run) parts.push_back({run, 0, 4});
  const ShareBasis basis = share_basis(clusters_of_runs(released, 4));
  const std::vector<ClusterShare> some(5, {4, 4});
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
  const std::vector<double> released(least_clusters - 1, 4.0);
  const ShareBasis basis = share_basis(clusters_of_runs(released, 4));
  EXPECT_TRUE(std::isnan(share_interval(basis, std::vector<BlockWeight>{{0, 0, 4}}, 0.1).low));
  EXPECT_TRUE(std::isnan(interval_of_none_or_all(basis, true).high));
}

// Ten runs that agree are ten trials, not proof: none, all, and the same part in each.
TEST(ShareInterval, OfRunsThatAgreeCountsRuns) {
  const std::vector<double> released(10, 4.0);
  const ShareBasis basis = share_basis(clusters_of_runs(released, 4));
  EXPECT_EQ(interval_of_none_or_all(basis, false).low, 0);
  EXPECT_DOUBLE_EQ(interval_of_none_or_all(basis, false).high, wilson_interval(0, 10).high);
  EXPECT_DOUBLE_EQ(interval_of_none_or_all(basis, true).low, wilson_interval(1, 10).low);
  EXPECT_EQ(interval_of_none_or_all(basis, true).high, 1);
  std::vector<BlockWeight> same;
  for (int run = 0; run < 10; ++run) same.push_back({run, 0, 0.1 * 4});
  EXPECT_DOUBLE_EQ(share_interval(basis, same, 0.1).high, wilson_interval(0.1, 10).high);
  EXPECT_DOUBLE_EQ(share_interval(basis, {}, 0).high, wilson_interval(0, 10).high);
}

TEST(RunShareInterval, IsWilsonsOfTheRuns) {
  const auto of = [](int n_hit, int n) {
    return run_share_interval(share_basis(clusters_of_runs(std::vector<double>(n, 7.0), 7)),
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

// 40 runs, R = 0.10, 0.8 of the blocks in five of them: worth 0.09 / v = 50.14 trials.
TEST(RunsToAdd, FollowFromTheVarianceOfTheRunsThereAre) {
  const ShareBasis basis = share_basis(clusters_of_runs(std::vector<double>(40, 1), 10));
  std::vector<BlockWeight> blocks;
  for (int run = 0; run < 5; ++run) blocks.push_back({run, 0, 0.8});
  const double n_trials = 0.09 / (40.0 / 39 * (4 * 0.8 - 0.4) / 1600);
  EXPECT_EQ(runs_to_add(basis, blocks, 0.1, 0.05).n, std::ceil(40 * 141 / n_trials) - 40);
  EXPECT_EQ(runs_to_add(basis, blocks, 0.1, 0.03).n, std::ceil(40 * 388 / n_trials) - 40);
  EXPECT_EQ(runs_to_add(basis, blocks, 0.1, 0.1).n, 0);
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

// The same for rocks of release cells, of one run and of ten: the error of 1,000 ensembles is 0.7 %
// of 95 % and 0.9 % of 90 %.
TEST(ShareInterval, HoldsTheTruthInSimulatedRocksOfCells) {
  std::uint64_t seed = 100;
  for (const double share : {0.05, 0.3})
    for (const double rho : {0.05, 0.5})
      for (const auto& [n_runs, n_each] : {std::pair{1, 1}, {1, 5}, {10, 1}}) {
        const CellCoverage c = cell_coverage(n_runs, 100, n_each, share, rho, 1000, ++seed);
        EXPECT_GE(c.cells, 0.93) << share << " " << rho << " " << n_runs << " " << n_each;
        EXPECT_GE(c.cells_90, 0.875) << share << " " << rho << " " << n_runs << " " << n_each;
      }
  // neither do the rocks of a cell count as many trials, nor do runs that fall over the same ground
  const CellCoverage c = cell_coverage(10, 100, 2, 0.3, 0.5, 300, 7);
  EXPECT_LE(c.rocks, 0.7);
  EXPECT_LE(c.runs, 0.6);
}

// Cells of which each always or never comes differ as much in any number of runs. Where rocks of
// one cell differ as much as rocks of different cells, so many runs more make the interval as
// narrow as wanted.
TEST(RunsToAdd, OfReleaseCellsAverageWhatDiffersWithinThem) {
  constexpr int n_cells = 300, n_runs = 4;
  const std::vector<RunMember> runs = runs_of_cells(n_runs, n_cells, 1);
  const ShareBasis basis = share_basis(clusters_of(runs));
  std::vector<BlockWeight> same, mixed;
  Random random(3);
  for (int run = 0; run < n_runs; ++run)
    for (int cell = 0; cell < n_cells; ++cell) {
      if (cell % 2 == 0) same.push_back({run, cell, 1});
      if (random.uniform() < 0.5) mixed.push_back({run, cell, 1});
    }
  EXPECT_FALSE(runs_to_add(basis, same, 0.5, 0.03).help);
  EXPECT_TRUE(runs_to_add(basis, same, 0.5, 0.06).help);  // as it is, with 300 trials
  EXPECT_EQ(runs_to_add(basis, same, 0.5, 0.06).n, 0);
  // 4,255 trials are wanted for 0.015: 15 runs of 300 rocks
  const double share = static_cast<double>(mixed.size()) / basis.over.whole;
  const RunsToAdd more = runs_to_add(basis, mixed, share, 0.015);
  EXPECT_TRUE(more.help);
  EXPECT_NEAR(more.n, 11, 4);
}

// Runs of one rock mass are one observation: 200 runs over 10 masses are worth ten, not 200. Each
// mass has a probability of its own, as joints that are cut anew give it.
TEST(ShareInterval, RunsOfOneRockMassCountAsOne) {
  constexpr int n_masses = 20, n_each = 10, n_trials = 400;
  Random random(11);
  int by_mass = 0, by_run = 0;
  const std::vector<double> released(n_masses * n_each, 1);
  std::vector<int> unit;
  for (int run = 0; run < n_masses * n_each; ++run) unit.push_back(run % n_masses);
  const ShareBasis masses = share_basis(clusters_of_runs(released, 1, unit)),
                   runs = share_basis(clusters_of_runs(released, 1));
  EXPECT_EQ(masses.over.n, n_masses);
  EXPECT_EQ(text(masses.clusters), "20 rock masses");
  for (int trial = 0; trial < n_trials; ++trial) {
    std::vector<double> chance;  // uniform: mean 0.5
    for (int m = 0; m < n_masses; ++m) chance.push_back(random.uniform());
    std::vector<BlockWeight> parts;
    for (int run = 0; run < n_masses * n_each; ++run)
      if (random.uniform() < chance[run % n_masses]) parts.push_back({run, 0, 1});
    const double share = static_cast<double>(parts.size()) / (n_masses * n_each);
    const auto holds = [](const Interval& i) { return i.low <= 0.5 && 0.5 <= i.high; };
    by_mass += holds(share_interval(masses, parts, share));
    by_run += holds(share_interval(runs, parts, share));
    const Interval of_runs = run_share_interval(masses, parts);
    EXPECT_NEAR(of_runs.low, share_interval(masses, parts, share).low, 1e-12);
  }
  EXPECT_GE(by_mass, 0.93 * n_trials);
  EXPECT_LE(by_run, 0.75 * n_trials);
  // nothing reached: as many trials as masses
  EXPECT_NEAR(run_share_interval(masses, 0.0).high, wilson_interval(0, n_masses).high, 1e-12);
}

// Cases weigh runs, rock masses bind them: 12 masses of a run of weight 1.5 and one of 0.5 are
// worth 12, and the half of the runs that weighs 0.75 is 0.75.
TEST(RunShareInterval, OfWeighedRunsOfRockMassesCountsMasses) {
  std::vector<double> weight;
  std::vector<int> unit;
  std::vector<BlockWeight> heavy;
  for (int run = 0; run < 24; ++run) {
    weight.push_back(run % 2 == 0 ? 1.5 : 0.5);
    unit.push_back(run / 2);
    if (run % 2 == 0) heavy.push_back({run, 0, 1});
  }
  const ShareBasis basis = share_basis(clusters_of_runs(weight, 2, unit, weight));
  EXPECT_NEAR(run_share_interval(basis, 0.0).high, wilson_interval(0, 12).high, 1e-12);
  const Interval of_masses = run_share_interval(basis, heavy);  // each mass has 0.75 of it
  EXPECT_NEAR(of_masses.low, wilson_interval(0.75, 12).low, 1e-12);
  EXPECT_NEAR(of_masses.high, wilson_interval(0.75, 12).high, 1e-12);
  const ShareBasis alone = share_basis(clusters_of_runs(weight, 2, {}, weight));
  const double n_eff = 24.0 * 24 / (12 * (1.5 * 1.5 + 0.5 * 0.5));
  EXPECT_NEAR(run_share_interval(alone, heavy).high, wilson_interval(0.75, n_eff).high, 1e-12);
}
