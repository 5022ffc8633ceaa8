// Places of a site: cells, blocks that reach them, intervals.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "post/places.hpp"
#include "run_maker.hpp"

namespace {

using namespace talus;           // NOLINT: a test
using namespace talus::testing;  // NOLINT: a test

// 10 x 10 cells of 5 m from (0, 50) to (50, 0).
PassageGrid grid() { return {{0, 50}, 5, 10, 10}; }

int n_touched(const std::vector<std::uint8_t>& cells) {
  return std::accumulate(cells.begin(), cells.end(), 0);
}

RunFile run_over(const std::vector<std::pair<int, int>>& block_and_cell, int n) {
  RunFile run;
  for (int b = 0; b < n; ++b) add_box(run, Vec3(1, 1, 1), Vec3(b, 0, 0));
  run.grid = grid();
  for (const auto& [block, cell] : block_and_cell) {
    Passage passage;
    passage.block = block;
    passage.cell = cell;
    run.passages.push_back(passage);
  }
  return run;
}

}  // namespace

// No block that came over the place is missed: a hut in the corner of a cell touches it.
TEST(Places, CellsAreThoseThatTheAreaTouches) {
  const auto hut = cells_touched(grid(), {{{11, 11}, {12, 11}, {12, 12}, {11, 12}}});
  EXPECT_EQ(n_touched(hut), 1);
  EXPECT_EQ(hut[7 * 10 + 2], 1);
  const auto across = cells_touched(grid(), {{{12, 17}, {23, 17}, {23, 18}, {12, 18}}});
  EXPECT_EQ(n_touched(across), 3);
  // a ring in a ring is a hole, whose rim is touched
  const auto yard = cells_touched(
      grid(), {{{1, 1}, {49, 1}, {49, 49}, {1, 49}}, {{11, 11}, {39, 11}, {39, 39}, {11, 39}}});
  EXPECT_EQ(n_touched(yard), 100 - 16);
  EXPECT_EQ(n_touched(cells_touched(grid(), {{{100, 100}, {110, 100}, {110, 110}}})), 0);
}

namespace {

std::vector<BlockWeight> reaching(const Place& place, const RunFile& run,
                                  const std::vector<Passage>& passages) {
  std::vector<BlockWeight> blocks;
  add_reaching(blocks, place, run, 0, passages);
  return blocks;
}

}  // namespace

TEST(Places, ABlockCountsOnceHoweverManyCellsItCrosses) {
  Place place{"hut", 0.05, cells_touched(grid(), {{{1, 1}, {9, 1}, {9, 9}, {1, 9}}}), ""};
  const RunFile run = run_over({{0, 90}, {0, 91}, {0, 80}, {2, 5}}, 3);
  EXPECT_EQ(reaching(place, run, run.passages).size(), 1U);
  place.cells.clear();
  place.line = "road";
  EXPECT_TRUE(reaching(place, run, run.passages).empty());
  RunFile crossed = run;
  crossed.lines = {record_line("road.1", {Vec3(0, 0, 0), Vec3(1, 0, 0)}),
                   record_line("roadside", {Vec3(0, 9, 0), Vec3(1, 9, 0)})};
  Crossing crossing;
  crossing.block = 1;
  crossed.crossings = {crossing, crossing};
  crossed.crossings[1].block = 2;
  crossed.crossings[1].line = 1;
  const std::vector<BlockWeight> blocks = reaching(place, crossed, {});
  ASSERT_EQ(blocks.size(), 1U);
  EXPECT_EQ(blocks[0].block, 1);
  EXPECT_EQ(blocks[0].weight, 1);
}

// R = 0.10 in 40 runs of single blocks: half width of Wilson's interval 0.0947; 141 trials are
// needed for 0.05, 388 for 0.03.
TEST(Places, SayHowManyRunsToAdd) {
  const ShareBasis basis = share_basis(clusters_of_runs(std::vector<double>(40, 1), 1));
  std::vector<BlockWeight> blocks;
  for (int i = 0; i < 4; ++i) blocks.push_back({10 * i, 0, 1});
  Place place{"hut", 0.05, {}, "x"};
  const PlaceReach reach = place_reach(place, basis, blocks);
  EXPECT_NEAR(reach.share, 0.1, 1e-12);
  EXPECT_NEAR(reach.half_width, (wilson_interval(0.1, 40).high - wilson_interval(0.1, 40).low) / 2,
              1e-12);
  EXPECT_EQ(reach.to_add.n, 101);
  place.half_width = 0.03;
  EXPECT_EQ(place_reach(place, basis, blocks).to_add.n, 348);
  place.half_width = 0.1;
  EXPECT_EQ(place_reach(place, basis, blocks).to_add.n, 0);
}

// Nothing reached is an answer too: 0 to 0.0370 of 100 runs, half width 0.0185.
TEST(Places, NothingReachedHasAWidthAsWell) {
  const auto basis = [](int n_runs) {
    return share_basis(clusters_of_runs(std::vector<double>(n_runs, 3), 3));
  };
  Place place{"hut", 0.02, {}, "x"};
  PlaceReach reach = place_reach(place, basis(100), {});
  EXPECT_NEAR(reach.interval.high, 0.036993, 1e-6);
  EXPECT_EQ(reach.to_add.n, 0);
  place.half_width = 0.01;
  reach = place_reach(place, basis(100), {});
  EXPECT_GT(reach.to_add.n, 50);
  EXPECT_LT(reach.to_add.n, 150);
  EXPECT_EQ(place_reach(place, basis(5), {}).to_add.n, 5);
}

// A run that weighs 3 of 40 and one of 1: a tenth of the runs' weight by two runs.
TEST(Places, RunsCountByTheWeightOfTheirCase) {
  std::vector<double> run_weight(38, 1), released;
  run_weight[7] = 3;
  for (const double w : run_weight) released.push_back(2 * w);
  const ShareBasis basis = share_basis(clusters_of_runs(released, 2, {}, run_weight));
  const std::vector<BlockWeight> blocks = {{7, 0, 3}, {8, 1, 1}};  // one block of two
  const PlaceReach reach = place_reach({"hut", 0.05, {}, "x"}, basis, blocks);
  EXPECT_EQ(reach.n_runs_hit, 2);
  EXPECT_NEAR(reach.share, 4.0 / 80, 1e-12);
  EXPECT_NEAR(reach.share_of_runs, 0.1, 1e-12);
  EXPECT_NEAR(reach.interval_of_runs.high, wilson_interval(0.1, 1600.0 / 46).high, 1e-12);
}
