// Steps of one height along a straight line of nodes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "terrain/seams.hpp"

namespace talus {
namespace {

constexpr int n = 60;

// Hills of some metres on a slope, 5 m a cell, with noise of centimetres.
Trn hills() {
  Trn trn;
  trn.n_rows = trn.n_cols = n;
  trn.cell_size = 5;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      trn.elevation.push_back(800 - 2.5 * r + 6 * std::sin(0.21 * r) * std::cos(0.17 * c) +
                              0.03 * std::sin(12.9 * r + 78.2 * c));
  return trn;
}

void raise(int first_row, int first_col, double height, Trn& trn) {
  for (int r = first_row; r < n; ++r)
    for (int c = first_col; c < n; ++c) trn.elevation[node_index(trn, r, c)] += height;
}

TEST(Seams, HillsHaveNone) { EXPECT_TRUE(find_seams(hills()).empty()); }

TEST(Seams, OneBetweenColumns) {
  Trn trn = hills();
  raise(0, 25, 7, trn);
  const std::vector<Seam> seams = find_seams(trn);
  ASSERT_EQ(seams.size(), 1u);
  EXPECT_FALSE(seams[0].between_rows);
  EXPECT_EQ(seams[0].line, 24);
  EXPECT_NEAR(seams[0].step_m, 7, 0.2);
}

TEST(Seams, OneBetweenRowsDownwardsBesideUnknownGround) {
  Trn trn = hills();
  raise(40, 0, -49.7, trn);
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < 9; ++c)
      trn.elevation[node_index(trn, r, c)] = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Seam> seams = find_seams(trn);
  ASSERT_EQ(seams.size(), 1u);
  EXPECT_TRUE(seams[0].between_rows);
  EXPECT_EQ(seams[0].line, 39);
  EXPECT_NEAR(seams[0].step_m, -49.7, 0.2);
}

TEST(Seams, ACliffThatEndsOrVariesIsNone) {
  Trn trn = hills();
  for (int r = 0; r < n / 2; ++r)
    for (int c = 30; c < n; ++c) trn.elevation[node_index(trn, r, c)] += 20;
  EXPECT_TRUE(find_seams(trn).empty());
  Trn wedge = hills();
  for (int r = 0; r < n; ++r)
    for (int c = 30; c < n; ++c) wedge.elevation[node_index(wedge, r, c)] += 0.5 * r;
  EXPECT_TRUE(find_seams(wedge).empty());
}

}  // namespace
}  // namespace talus
