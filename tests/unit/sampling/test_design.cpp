// Designs: Sobol points, scrambling, hypercubes.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "sampling/design.hpp"

namespace {

using namespace talus;  // NOLINT: a test

double plain(std::uint64_t point, int dimension) {
  return static_cast<double>(sobol_bits(point, dimension) >> 11) * 0x1p-53;
}

// Joe and Kuo (2008): the first points of the sequence, as published with their direction numbers.
TEST(Design, SobolBeginsWithThePublishedPoints) {
  const double published[8][4] = {{0, 0, 0, 0},
                                  {0.5, 0.5, 0.5, 0.5},
                                  {0.75, 0.25, 0.25, 0.25},
                                  {0.25, 0.75, 0.75, 0.75},
                                  {0.375, 0.375, 0.625, 0.875},
                                  {0.875, 0.875, 0.125, 0.375},
                                  {0.625, 0.125, 0.875, 0.625},
                                  {0.125, 0.625, 0.375, 0.125}};
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 4; ++k)
      EXPECT_EQ(plain(static_cast<std::uint64_t>(i), k), published[i][k]) << i << ", " << k;
}

// Each of the first 2^m points has an interval of 2^-m to itself, in every coordinate and scrambled
// or not; of two coordinates, each elementary box of that area (those of a net of t = 0).
TEST(Design, ScrambledSobolPointsShareOutTheCube) {
  const Design design{Sampling::sobol, 7};
  constexpr int m = 6, n = 1 << m;
  for (const std::string name : {"a", "b"})
    for (int k = 0; k < 12; ++k) {
      std::set<int> taken;
      for (int i = 0; i < n; ++i)
        taken.insert(
            static_cast<int>(unit_value(design, static_cast<std::uint64_t>(i), k, name) * n));
      EXPECT_EQ(taken.size(), n) << name << k;
    }
  for (int a = 0; a <= m; ++a) {
    std::set<int> boxes;
    for (std::uint64_t i = 0; i < n; ++i)
      boxes.insert(static_cast<int>(unit_value(design, i, 0, "x") * (1 << a)) * n +
                   static_cast<int>(unit_value(design, i, 1, "y") * (1 << (m - a))));
    EXPECT_EQ(boxes.size(), n) << a;
  }
}

// The mean of x1 + x2 + x3 over 64 points: random ones scatter by 0.0625 around 1.5; scrambled
// Sobol points by the -3/2 power, 64 ^ -1.5 = 0.002, times a small number.
TEST(Design, ScrambledSobolMeansScatterFarLessThanRandomOnes) {
  const auto spread = [](Sampling sampling, int n_seeds) {
    constexpr int n = 64;
    double squares = 0;
    for (int seed = 1; seed <= n_seeds; ++seed) {
      const Design design{sampling, static_cast<std::uint64_t>(seed), n};
      double sum = 0;
      for (std::uint64_t i = 0; i < n; ++i)
        for (int k = 0; k < 3; ++k) sum += unit_value(design, i, k, "q" + std::to_string(k));
      squares += std::pow(sum / n - 1.5, 2);
    }
    return std::sqrt(squares / n_seeds);
  };
  EXPECT_NEAR(spread(Sampling::random, 1000), 0.0625, 0.005);
  EXPECT_LT(spread(Sampling::sobol, 60), 0.002);
  EXPECT_LT(spread(Sampling::hypercube, 60), 0.002);
}

TEST(Design, AHypercubeHasOnePointInEachStratum) {
  const Design design{Sampling::hypercube, 3, 50};
  for (int k = 0; k < 3; ++k) {
    std::set<int> taken;
    for (std::uint64_t i = 0; i < 50; ++i)
      taken.insert(static_cast<int>(unit_value(design, i, k, "q") * 50));
    EXPECT_EQ(taken.size(), 50U);
  }
}

TEST(Design, NumbersHangOnTheirWordsAlone) {
  const Design design{Sampling::sobol, 1};
  std::vector<double> forth, back;
  for (std::uint64_t i = 0; i < 100; ++i) forth.push_back(unit_value(design, i, 1, "friction"));
  for (std::uint64_t i = 100; i-- > 0;) back.push_back(unit_value(design, i, 1, "friction"));
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(forth[i], back[99 - i]);
  EXPECT_NE(unit_value(design, 5, 1, "friction"), unit_value(design, 5, 1, "cohesion"));
  EXPECT_NE(unit_value(design, 5, 1, "friction"),
            unit_value({Sampling::sobol, 2}, 5, 1, "friction"));
  for (std::uint64_t i = 0; i < 4096; ++i) {
    const double u = unit_value(design, i, 0, "q");
    ASSERT_TRUE(u > 0 && u < 1);
  }
}

// Runs i, i + 16, i + 32 ... share a set of blocks. Taken in the order of the sequence, their
// points lie in one sixteenth of the first coordinate: blocks and number could not be told apart.
TEST(Design, RunsOfOneRockMassAreSpreadOverTheOtherQuantities) {
  const Design design{Sampling::sobol, 1};
  constexpr std::uint64_t n_masses = 16, n_rounds = 32;
  double worst = 0, worst_in_order = 0;
  for (std::uint64_t mass = 0; mass < n_masses; ++mass) {
    double sum = 0, in_order = 0;
    for (std::uint64_t round = 0; round < n_rounds; ++round) {
      const std::uint64_t run = round * n_masses + mass;
      sum += unit_value(design, point_of_run(design, run, n_masses), 0, "friction");
      in_order += unit_value(design, run, 0, "friction");
    }
    worst = std::max(worst, std::abs(sum / n_rounds - 0.5));
    worst_in_order = std::max(worst_in_order, std::abs(in_order / n_rounds - 0.5));
  }
  EXPECT_GT(worst_in_order, 0.4);
  EXPECT_LT(worst, 0.18);  // 3.5 standard deviations of the mean of 32 numbers
  std::set<std::uint64_t> points;
  for (std::uint64_t run = 0; run < n_masses * n_rounds; ++run)
    points.insert(point_of_run(design, run, n_masses));
  EXPECT_EQ(points.size(), n_masses * n_rounds);
  EXPECT_EQ(*points.rbegin(), n_masses * n_rounds - 1);
}

}  // namespace
