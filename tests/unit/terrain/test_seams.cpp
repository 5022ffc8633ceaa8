// Steps of one height along a straight line of nodes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "terrain/seams.hpp"

namespace talus {
namespace {

constexpr int n = 60;

// Hills of some metres on a slope, 5 m a cell, with noise of centimetres.
Trn hills(int n = 60) {
  Trn trn;
  trn.n_rows = trn.n_cols = n;
  trn.cell_size = 5;
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      trn.elevation.push_back(800 - 2.5 * r + 6 * std::sin(0.21 * r) * std::cos(0.17 * c) +
                              0.03 * std::sin(12.9 * r + 78.2 * c));
  return trn;
}

// Rows and columns from the first to the last.
void raise(int first_row, int last_row, int first_col, int last_col, double height, Trn& trn) {
  for (int r = first_row; r <= last_row; ++r)
    for (int c = first_col; c <= last_col; ++c) trn.elevation[node_index(trn, r, c)] += height;
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

bool has(const std::vector<Seam>& seams, bool between_rows, int line, double step_m) {
  return std::any_of(seams.begin(), seams.end(), [&](const Seam& seam) {
    return seam.between_rows == between_rows && seam.line == line &&
           std::abs(seam.step_m - step_m) < 0.05;
  });
}

TEST(Seams, ATileThatEndsInsideHasTwoOrThree) {
  Trn corner = hills();
  raise(0, 29, 30, n - 1, 0.8, corner);
  std::vector<Seam> seams = find_seams(corner);
  ASSERT_EQ(seams.size(), 2u);
  EXPECT_TRUE(has(seams, false, 29, 0.8));
  EXPECT_TRUE(has(seams, true, 29, -0.8));
  EXPECT_NEAR(seams[0].middle, 15, 2);
  Trn side = hills();
  raise(20, 45, 0, 33, -1.2, side);
  seams = find_seams(side);
  ASSERT_EQ(seams.size(), 3u);
  EXPECT_TRUE(has(seams, false, 33, 1.2));
  EXPECT_TRUE(has(seams, true, 19, -1.2));
  EXPECT_TRUE(has(seams, true, 45, 1.2));
}

// Roughness of 0.25 m makes single steps unlike: they scatter by 0.6 m.
TEST(Seams, OnRoughGroundTheMediansShowIt) {
  std::mt19937 random(1);
  std::normal_distribution<double> rough(0, 0.25);
  Trn trn = hills(600);
  for (double& z : trn.elevation) z += rough(random);
  EXPECT_TRUE(find_seams(trn).empty());
  raise(0, 299, 280, 599, 1.5, trn);
  const std::vector<Seam> seams = find_seams(trn);
  ASSERT_EQ(seams.size(), 2u);
  EXPECT_EQ(seams[0].line, 279);
  EXPECT_EQ(seams[1].line, 299);
}

TEST(Seams, OneThatEndsOnAnotherOne) {
  Trn stem = hills();
  raise(0, 25, 0, n - 1, 3, stem);
  raise(26, n - 1, 36, n - 1, 0.8, stem);
  const std::vector<Seam> seams = find_seams(stem);
  EXPECT_TRUE(has(seams, false, 36 - 1, 0.8));
  EXPECT_TRUE(has(seams, true, 25, -3) || has(seams, true, 25, -2.2));
}

TEST(Seams, ATileBesideUnknownGround) {
  Trn trn = hills();
  raise(0, 29, 30, n - 1, 0.8, trn);
  raise(30, n - 1, 0, n - 1, std::nan(""), trn);
  const std::vector<Seam> seams = find_seams(trn);
  ASSERT_EQ(seams.size(), 1u);
  EXPECT_TRUE(has(seams, false, 29, 0.8));
}

// As the last contour of a map leaves it, which runs along its border for a while.
TEST(Seams, TheRimHasNone) {
  Trn trn = hills();
  raise(58, n - 1, 0, n - 1, std::nan(""), trn);
  raise(56, 57, 30, n - 1, 2, trn);
  raise(56, 57, 0, 29, std::nan(""), trn);
  EXPECT_TRUE(find_seams(trn).empty());
}

TEST(Seams, ATileInTheMiddleIsOneAHouseIsNone) {
  Trn tile = hills(120);
  raise(25, 94, 30, 99, 0.8, tile);
  EXPECT_EQ(find_seams(tile).size(), 4u);
  Trn house = hills(120);
  raise(25, 54, 30, 69, 8, house);
  EXPECT_TRUE(find_seams(house).empty());
}

// Each contour of the rounding is a step of one metre, here along columns and rows.
TEST(Seams, WholeMetresOfLevelGroundHaveNone) {
  Trn trn = hills(120);
  for (int r = 0; r < 120; ++r)
    for (int c = 0; c < 120; ++c)
      trn.elevation[node_index(trn, r, c)] = std::round(500.3 + 0.03 * std::max(r, c));
  EXPECT_TRUE(find_seams(trn).empty());
  raise(0, 59, 50, 119, 4, trn);
  EXPECT_EQ(find_seams(trn).size(), 2u);
}

TEST(Seams, ACliffThatEndsOrVariesIsNone) {
  Trn trn = hills();
  for (int r = 0; r < 40; ++r)
    for (int c = 30; c < n; ++c)
      trn.elevation[node_index(trn, r, c)] +=
          20 * std::min(1.0, 0.1 * (40 - r)) * std::exp(-0.1 * (c - 30));
  EXPECT_TRUE(find_seams(trn).empty());
  Trn wedge = hills();
  for (int r = 0; r < n; ++r)
    for (int c = 30; c < n; ++c) wedge.elevation[node_index(wedge, r, c)] += 0.5 * r;
  EXPECT_TRUE(find_seams(wedge).empty());
}

}  // namespace
}  // namespace talus
