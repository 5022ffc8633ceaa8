// Errors and slopes of a TRN.
#include <gtest/gtest.h>

#include <numeric>

#include "random_trn.hpp"
#include "terrain/trn_quality.hpp"

namespace {

using talus::Trn;

// Errors of 1 .. 100 with alternating sign: sums of whole numbers and of their squares.
TEST(ErrorCollector, StatisticsOfAKnownSequence) {
  const Trn trn = talus_test::planar_trn(3, 102, 1, 0, 0);
  talus::ErrorCollector collector;
  for (int i = 100; i >= 1; --i) collector.add(trn, i, -1, 1000 + (i % 2 == 0 ? i : -i));
  collector.add(trn, -5, -1, 1000);
  const talus::ErrorStatistics s = collector.statistics();
  EXPECT_EQ(s.n, 100);
  EXPECT_EQ(s.n_uncovered, 1);
  EXPECT_NEAR(s.mean, -0.5, 1e-12);
  EXPECT_NEAR(s.mae, 50.5, 1e-12);
  EXPECT_NEAR(s.rmse, std::sqrt(100 * 101 * 201 / 6 / 100.0), 1e-12);
  EXPECT_NEAR(s.p95, 95, 1e-12);
  EXPECT_NEAR(s.largest, -100, 1e-12);
  EXPECT_EQ(s.largest_at, talus::Vec2(100, -1));
}

TEST(ErrorCollector, WithoutTruthAllIsZero) {
  EXPECT_EQ(talus::ErrorCollector().statistics().n, 0);
  EXPECT_EQ(talus::ErrorCollector().statistics().rmse, 0);
}

// The north-eastern nodes of known ground have no known triangle to the south-east of them.
TEST(ElevationOrNode, KnowsNodesThatNoKnownTriangleOwns) {
  Trn trn = talus_test::planar_trn(4, 4, 2, 0.5, 0);
  trn.elevation[talus::node_index(trn, 1, 2)] = std::nan("");
  trn.elevation[talus::node_index(trn, 2, 2)] = std::nan("");
  EXPECT_TRUE(std::isnan(talus::elevation_at(trn, 2, -2)));
  EXPECT_EQ(talus::elevation_or_node(trn, 2, -2), 1001);
  EXPECT_EQ(talus::elevation_or_node(trn, 2 + 1e-7, -2), 1001);
  EXPECT_TRUE(std::isnan(talus::elevation_or_node(trn, 4, -2)));
  EXPECT_NEAR(talus::elevation_or_node(trn, 0.5, -1.2), 1000.25, 1e-12);
  EXPECT_TRUE(std::isnan(talus::elevation_or_node(trn, -2, -2)));
}

TEST(SlopeStatistics, OfAPlaneAreItsSlope) {
  const double slope = std::tan(32 * M_PI / 180);
  const talus::SlopeStatistics s =
      talus::slope_statistics(talus_test::planar_trn(11, 21, 5, 0.6 * slope, -0.8 * slope));
  EXPECT_EQ(s.n_nodes_known, 231);
  EXPECT_EQ(s.n_triangles, 400);
  EXPECT_EQ(s.n_in_bin[6], 400);
  EXPECT_EQ(s.n_flat, 0);
  EXPECT_EQ(s.n_cells_steep, 0);
  EXPECT_NEAR(s.mean_deg, 32, 1e-9);
  EXPECT_NEAR(s.largest_deg, 32, 1e-9);
}

TEST(SlopeStatistics, CountFlatSteepAndUnknown) {
  Trn trn = talus_test::planar_trn(5, 5, 1, 0, 0);
  trn.elevation[talus::node_index(trn, 0, 0)] = std::nan("");  // two triangles less
  trn.elevation[talus::node_index(trn, 4, 4)] += 3;            // slopes of 71.6 degrees
  const talus::SlopeStatistics s = talus::slope_statistics(trn);
  EXPECT_EQ(s.n_nodes_known, 24);
  EXPECT_EQ(s.n_triangles, 30);
  EXPECT_EQ(s.n_cells, 15);
  EXPECT_EQ(s.n_flat, 28);
  EXPECT_EQ(s.n_cells_steep, 1);
  EXPECT_EQ(s.n_in_bin[14], 2);
  EXPECT_EQ(std::accumulate(s.n_in_bin.begin(), s.n_in_bin.end(), std::int64_t{0}), 30);
}

}  // namespace
