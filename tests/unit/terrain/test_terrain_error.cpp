// Drawn errors of a terrain: size and correlation.
#include <gtest/gtest.h>

#include <cmath>

#include "terrain/terrain_error.hpp"

namespace {

using namespace talus;  // NOLINT: a test

Trn flat_ground(int n, double cell_size) {
  Trn trn;
  trn.n_rows = trn.n_cols = n;
  trn.cell_size = cell_size;
  trn.origin = {500000, 5200000, 0};
  trn.elevation.assign(static_cast<std::size_t>(n) * n, 100);
  return trn;
}

// Mean of e(x) e(x + d) along the rows, over many fields.
double covariance(int d, double rmse, double correlation) {
  constexpr int n = 120, n_fields = 12;
  const Trn ground = flat_ground(n, 5);
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= n_fields; ++seed) {
    const Trn off = with_error(ground, rmse, correlation, seed);
    for (int r = 0; r < n; ++r)
      for (int c = 0; c + d < n; ++c) {
        const std::size_t i = static_cast<std::size_t>(r) * n + c;
        sum += (off.elevation[i] - 100) * (off.elevation[i + d] - 100);
        ++count;
      }
  }
  return sum / count;
}

// exp(-(d / L)^2): 1 at 0, 1 / e at L, 0.018 at 2 L.
TEST(TerrainError, HasTheSizeAndTheCorrelationThatWereGiven) {
  EXPECT_NEAR(std::sqrt(covariance(0, 0.8, 20)), 0.8, 0.03);
  EXPECT_NEAR(covariance(2, 0.8, 20) / 0.64, std::exp(-0.25), 0.06);
  EXPECT_NEAR(covariance(4, 0.8, 20) / 0.64, std::exp(-1.0), 0.06);
  EXPECT_NEAR(covariance(8, 0.8, 20) / 0.64, std::exp(-4.0), 0.06);
  EXPECT_NEAR(covariance(1, 0.8, 0.5) / 0.64, 0, 0.03);  // far less than a cell: independent
}

TEST(TerrainError, OfAPlaceIsThatOfTheSeedWhateverTheWindow) {
  const Trn whole = flat_ground(60, 5);
  const Trn off = with_error(whole, 1, 20, 3);
  EXPECT_EQ(off.elevation, with_error(whole, 1, 20, 3).elevation);
  EXPECT_NE(off.elevation, with_error(whole, 1, 20, 4).elevation);
  EXPECT_EQ(with_error(whole, 0, 20, 3).elevation, whole.elevation);
  Trn part = flat_ground(20, 5);
  part.node0 = {50, -75};  // from column 10, row 15
  part.elevation[7] = std::nan("");
  const Trn part_off = with_error(part, 1, 20, 3);
  EXPECT_TRUE(std::isnan(part_off.elevation[7]));
  for (const int k : {0, 5, 19})
    EXPECT_NEAR(part_off.elevation[static_cast<std::size_t>(k) * 20 + k],
                off.elevation[static_cast<std::size_t>(15 + k) * 60 + 10 + k], 1e-12);
}

}  // namespace
