// Summaries of tree hits over runs.
#include <gtest/gtest.h>

#include "post/runout/tree_summary.hpp"

namespace {

using namespace talus;

TreeHitRow row_of(int stem, int block, double work, double left, int broken_by) {
  TreeHitRow row;
  row.stem = stem;
  row.foot = Vec3(stem, 2.0 * stem, 0);
  row.capacity = 100;
  row.left = left;
  row.broken_by = broken_by;
  row.hit.block = block;
  row.hit.work = work;
  return row;
}

// Two runs of one stand: stem 3 is hit by two blocks of the first run, and in both; stem 1 breaks.
TEST(TreeSummary, CountsRunsBlocksAndWhatIsLeft) {
  RunTrees one{{{"wood", 50}}, {row_of(3, 0, 20, 30, -1), row_of(3, 1, 50, 30, -1)}, {}};
  RunTrees two{{{"wood", 50}}, {row_of(1, 7, 100, 0, 7), row_of(3, 7, 10, 90, -1)}, {}};
  const TreeSummary sum = summary_of({one, two});
  ASSERT_EQ(sum.stems.size(), 2u);
  EXPECT_EQ(sum.stems[0].first.stem, 1);
  EXPECT_EQ(sum.stems[0].n_broken, 1);
  EXPECT_EQ(sum.stems[0].least_left, 0);
  EXPECT_EQ(sum.stems[1].n_runs, 2);
  EXPECT_EQ(sum.stems[1].n_hits, 3);
  EXPECT_EQ(sum.stems[1].n_broken, 0);
  EXPECT_EQ(sum.stems[1].largest_work, 50);
  EXPECT_EQ(sum.stems[1].least_left, 30);
  ASSERT_EQ(sum.forests.size(), 1u);
  EXPECT_EQ(sum.forests[0].n_runs, 2);
  EXPECT_EQ(sum.forests[0].stems, 50);
  EXPECT_EQ(sum.forests[0].hit, 1.5);
  EXPECT_EQ(sum.forests[0].broken, 0.5);
  EXPECT_EQ(sum.forests[0].work, 90);
}

// Where each run draws its stand, equal numbers are different stems.
TEST(TreeSummary, StemsOfTwoStandsAreNotOne) {
  RunTrees one{{{"wood", 50}}, {row_of(3, 0, 20, 80, -1)}, {}}, two = one;
  two.hits[0].foot += Vec3(0.5, 0, 0);
  EXPECT_EQ(summary_of({one, two}).stems.size(), 2u);
}

// Rocks that fall one by one: each met the whole wood, so that means are a rock's.
TEST(TreeSummary, CountsRockByRock) {
  RunTrees one{{{"wood", 50}},
               {row_of(3, 0, 20, 0, 0), row_of(3, 1, 50, 0, 1), row_of(3, 2, 10, 90, -1),
                row_of(4, 3, 10, 90, -1)},
               {0, 1, 2, 2, 4},
               true};
  const TreeSummary sum = summary_of({one});
  ASSERT_EQ(sum.stems.size(), 2u);
  EXPECT_EQ(sum.stems[0].n_runs, 1);
  EXPECT_EQ(sum.stems[0].n_hits, 3);
  EXPECT_EQ(sum.stems[0].n_broken, 2);
  EXPECT_EQ(sum.stems[1].n_broken, 0);
  ASSERT_EQ(sum.forests.size(), 1u);
  EXPECT_EQ(sum.forests[0].n_worlds, 4);
  EXPECT_DOUBLE_EQ(sum.forests[0].stems, 50);
  EXPECT_DOUBLE_EQ(sum.forests[0].hit, 1);
  EXPECT_DOUBLE_EQ(sum.forests[0].broken, 0.5);
}

}  // namespace
