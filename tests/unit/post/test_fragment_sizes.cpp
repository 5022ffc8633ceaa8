// Fractal dimension of fragment sizes.
#include <gtest/gtest.h>

#include <cmath>

#include "post/fragment_sizes.hpp"

namespace {

using namespace talus;

// Test F4.
TEST(FragmentSizes, DimensionFollowsFromRatioAndProbability) {
  EXPECT_NEAR(fractal_dimension(2, 0.9), 2.8480, 1e-4);
  EXPECT_NEAR(fractal_dimension(2, 0.7), 2.4854, 1e-4);
  EXPECT_NEAR(fractal_dimension(2, 0.5), 2.0000, 1e-4);
}

// Volumes at the quantiles of a power law give its dimension back.
TEST(FragmentSizes, DimensionOfAPowerLawIsFound) {
  for (const double dimension : {2.0, 2.5, 2.8}) {
    std::vector<double> volumes;
    constexpr int n = 20000;
    for (int i = 1; i <= n; ++i)
      volumes.push_back(0.01 * std::pow(static_cast<double>(i) / n, -3 / dimension));
    EXPECT_NEAR(fitted_dimension(volumes), dimension, 2e-3);
  }
}

TEST(FragmentSizes, CountPiecesAndWhatStayedWhole) {
  RunFile run;
  run.blocks.volume = {4, 1, 3, 2};
  run.blocks.generation = {0, 1, 1, 2};
  const FragmentSizes sizes = fragment_sizes(run);
  EXPECT_EQ(sizes.n_pieces, 3);
  EXPECT_EQ(sizes.n_unbroken, 1);
  EXPECT_EQ(sizes.unbroken_share, 0.4);
  EXPECT_EQ(sizes.largest, 3);
  EXPECT_TRUE(std::isnan(fitted_dimension(std::vector<double>{1.0, 1.0})));
}

}  // namespace
