// Independent clusters of blocks: runs, rock masses, release cells.
#include <gtest/gtest.h>

#include "ensemble/clusters.hpp"
#include "ensemble/made_with.hpp"

using namespace talus;

namespace {

// Two runs of rocks that fall one by one, each of two rocks from each of `n_cells` cells.
std::vector<RunMember> two_runs(int n_cells) {
  std::vector<RunMember> runs(2);
  for (RunMember& run : runs) {
    run.info.independent = true;
    for (int rock = 0; rock < 2; ++rock)
      for (int cell = 0; cell < n_cells; ++cell) run.release_cell.push_back(7 * cell);
    run.n_blocks = 2 * n_cells;
    run.weight = run.n_blocks;
  }
  return runs;
}

}  // namespace

TEST(Clusters, AreReleaseCellsOverAllRunsWhereNothingIsDrawnForARun) {
  std::vector<RunMember> runs = two_runs(12);
  runs[1].block_weight.assign(24, 0.5);
  runs[1].run_weight = 3;
  const Clusters cells = clusters_of(runs);
  EXPECT_EQ(text(cells), "12 release cells");
  EXPECT_EQ(cluster_of(cells, 0, 3), 3);
  EXPECT_EQ(cluster_of(cells, 0, 12 + 3), 3);
  EXPECT_EQ(cluster_of(cells, 1, 3), 3);
  for (const double weight : cells.weight) EXPECT_EQ(weight, 2 + 2 * 0.5 * 3);
  for (const int n : cells.n_blocks) EXPECT_EQ(n, 4);
  EXPECT_EQ(text(clusters_of(std::span(runs).first(1))), "12 release cells");
}

TEST(Clusters, AreRunsWhereRocksShareWhatIsDrawnOrCellsAreFewOrBlocksMeet) {
  EXPECT_EQ(text(clusters_of(two_runs(9))), "2 runs");
  std::vector<RunMember> runs = two_runs(12);
  runs[1].draws_for_all = true;
  EXPECT_EQ(text(clusters_of(runs)), "2 runs");
  EXPECT_EQ(cluster_of(clusters_of(runs), 1, 3), 1);
  runs = two_runs(12);
  runs[0].info.independent = false;
  EXPECT_EQ(text(clusters_of(runs)), "2 runs");
}

// Rocks of a site are drawn anew with each sample; their seeds alone are shared by nothing.
TEST(Clusters, WhatIsDrawnForARunIsToldFromItsRocks) {
  const std::string rocks = "[rockfall.cliff]\nseed = 4  # rock mass 3\n";
  EXPECT_FALSE(draws_for_all(made_with(rocks, "")));
  for (const char* more :
       {"[ground.slope]\nfriction_deg = 31  # sample 3 of uncertainty.friction\n",
        "[solver]\ncor_scatter = 0.05  # site\n",
        "[forest.wood]\nactive = true  # default\nnew_stand_per_run = true  # site\n",
        "[uncertainty]\nsample = 3  # cli\nterrain_rmse_m = 0.5  # site\n"})
    EXPECT_TRUE(draws_for_all(made_with(rocks + more, ""))) << more;
  EXPECT_FALSE(draws_for_all(made_with(rocks + "[solver]\ncor_scatter = 0  # default\n", "")));
}
