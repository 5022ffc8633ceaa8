// Drawn stands of trees: densities, diameters, hits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/stand.hpp"
#include "scene/stems.hpp"

namespace {

using namespace talus;

Stocking stocking(double stems_per_ha, double dbh_mean, double dbh_std) {
  Stocking made;
  made.stems_per_ha = stems_per_ha;
  made.dbh_mean = dbh_mean;
  made.dbh_std = dbh_std;
  return made;
}

std::vector<DrawnStem> stand_in(const Vec2& low, const Vec2& high, const Stocking& of,
                                const StandSeed& seed = {}) {
  std::vector<DrawnStem> stems;
  for (const StandCell& cell : stand_cells(low, high)) draw_cell(seed, cell, of, stems);
  return stems;
}

// Mean of DBH^2.31 over a gamma distribution of 30 +- 10 cm, which is not that of its mean.
TEST(Stand, MeanCapacityIsThatOfGammaDiameters) {
  const std::vector<DrawnStem> stems =
      stand_in(Vec2::Zero(), Vec2(1585, 1585), stocking(400, 0.30, 0.10));
  ASSERT_GT(stems.size(), 100000u);
  double sum = 0, dbh = 0, square = 0;
  for (const DrawnStem& stem : stems) {
    sum += stem_capacity(1, stem.dbh);
    dbh += stem.dbh;
    square += stem.dbh * stem.dbh;
  }
  const auto n = static_cast<double>(stems.size());
  EXPECT_NEAR(sum / n, 117055, 0.005 * 117055);
  EXPECT_NEAR(dbh / n, 0.30, 0.001);
  EXPECT_NEAR(std::sqrt(square / n - dbh * dbh / n / n), 0.10, 0.001);
}

// A ball of 1 m on 50 m through 400 stems of 30 cm a hectare, in 10,000 places of a large stand:
// 2.6 hits, none in exp(-2.6) of them. Tracks 20 m apart share no stem.
TEST(Stand, HitsOnAStraightTrackArePoissonDistributed) {
  const int n_tracks = 10000;
  const double reach = (1 + 0.30) / 2;
  int n_hits = 0, n_free = 0;
  for (int k = 0; k < n_tracks; ++k) {
    const Vec2 from(5000 + 3, 20.0 * k + 7);
    int hits = 0;
    for (const DrawnStem& stem :
         stand_in(from - Vec2(0, 1), from + Vec2(50, 1), stocking(400, 0.30, 0)))
      hits += stem.at.x() >= from.x() && stem.at.x() < from.x() + 50 &&
              std::abs(stem.at.y() - from.y()) <= reach;
    n_hits += hits;
    n_free += hits == 0;
  }
  const double free = std::exp(-2.6);
  EXPECT_NEAR(n_hits / double(n_tracks), 2.6, 3 * std::sqrt(2.6 / n_tracks));
  EXPECT_NEAR(n_free / double(n_tracks), free, 3 * std::sqrt(free * (1 - free) / n_tracks));
}

TEST(Stand, ACellDrawsTheSameWhoeverAsksInWhateverOrder) {
  const Stocking of = stocking(800, 0.25, 0.08);
  const std::vector<DrawnStem> whole = stand_in(Vec2(-40, -40), Vec2(95, 95), of);
  std::vector<StandCell> cells = stand_cells(Vec2(-40, -40), Vec2(95, 95));
  std::reverse(cells.begin(), cells.end());
  std::vector<DrawnStem> backwards;
  for (const StandCell& cell : cells) {
    std::vector<DrawnStem> one;
    draw_cell({}, cell, of, one);
    backwards.insert(backwards.begin(), one.begin(), one.end());
  }
  ASSERT_GT(whole.size(), 50u);
  ASSERT_EQ(whole.size(), backwards.size());
  for (std::size_t k = 0; k < whole.size(); ++k) {
    EXPECT_EQ(whole[k].at, backwards[k].at);
    EXPECT_EQ(whole[k].dbh, backwards[k].dbh);
  }
}

TEST(Stand, SeedsNamesAndRunsDrawOtherStands) {
  const Stocking of = stocking(800, 0.25, 0.08);
  const Vec2 low(0, 0), high(99, 99);
  const std::vector<DrawnStem> stems = stand_in(low, high, of);
  for (const StandSeed& seed : {StandSeed{2, "", 0}, StandSeed{1, "a", 0}, StandSeed{1, "", 1}}) {
    const std::vector<DrawnStem> others = stand_in(low, high, of, seed);
    for (const DrawnStem& other : others)
      for (const DrawnStem& stem : stems) EXPECT_GT((stem.at - other.at).norm(), 1e-9);
  }
}

// More trees leave those that were there, and other diameters leave their places.
TEST(Stand, ItsFirstStemsStayWhereTheyAre) {
  const StandCell cell = stand_cell_at(Vec2(1234, 5678), 25);
  std::vector<DrawnStem> few, many, thick;
  draw_cell({}, cell, stocking(300, 0.3, 0.1), few);
  draw_cell({}, cell, stocking(3000, 0.3, 0.1), many);
  draw_cell({}, cell, stocking(300, 0.5, 0.1), thick);
  ASSERT_GT(many.size(), few.size());
  ASSERT_EQ(thick.size(), few.size());
  ASSERT_FALSE(few.empty());
  for (std::size_t k = 0; k < few.size(); ++k) {
    EXPECT_EQ(few[k].at, many[k].at);
    EXPECT_EQ(few[k].at, thick[k].at);
    EXPECT_TRUE((few[k].at - cell.low).minCoeff() >= 0 && (few[k].at - cell.low).maxCoeff() < 25);
  }
}

TEST(Stand, ConifersHaveTheirShare) {
  Stocking of = stocking(2000, 0.3, 0.1);
  of.conifer_share = 0.3;
  const std::vector<DrawnStem> stems = stand_in(Vec2(0, 0), Vec2(499, 499), of);
  const auto n = std::count_if(stems.begin(), stems.end(),
                               [](const DrawnStem& stem) { return stem.is_conifer; });
  const auto all = static_cast<double>(stems.size());
  EXPECT_NEAR(static_cast<double>(n) / all, 0.3, 4 * std::sqrt(0.21 / all));
}

}  // namespace
