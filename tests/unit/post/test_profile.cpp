// Profiles along lines: energy, crossings, shares.
#include <gtest/gtest.h>

#include <cmath>

#include "post/profile/line_result.hpp"
#include "run_maker.hpp"

namespace {

using namespace talus;           // NOLINT: a test
using namespace talus::testing;  // NOLINT

constexpr double slope = 0.5;                             // of the plane [m/m]
constexpr double acceleration = 3;                        // along the plane [m/s2]
const double along_x = 1 / std::sqrt(1 + slope * slope);  // of a unit distance down the plane

RecordLine line_of(const Trn& trn, const std::vector<Vec2>& corners, double step) {
  return record_line("line", posts_on_ground(trn, corners, step, {"line"}));
}

// Boxes of 1 m that slide down the plane from x = 0, at each y of `ys`, frames every `dt` up to 8
// s.
RunFile sliding_run(const std::vector<double>& ys, double dt) {
  RunFile run;
  for (const double y : ys) add_box(run, {1, 1, 1}, {0, y, 101});
  for (int k = 0; k * dt <= 8; ++k) {
    const double t = k * dt, way = 0.5 * acceleration * t * t;
    std::vector<FrameBlock> at;
    for (const double y : ys) {
      at.push_back(standing({along_x * way, y, 101 - slope * along_x * way}));
      at.back().velocity = acceleration * t * Vec3(along_x, 0, -slope * along_x);
    }
    add_frame(run, t, at);
  }
  return run;
}

Passage passage(int block, int cell, float time, float energy, float speed, float top) {
  Passage row;
  row.block = block;
  row.cell = cell;
  row.first_time = time;
  row.largest.translational_energy = 0.75F * energy;
  row.largest.total_energy = energy;
  row.largest.speed = speed;
  row.largest.centroid_height = top / 2;
  row.largest.top_height = top;
  return row;
}

// Cells of 10 m over 100 m x 50 m; cell 10 r + c.
PassageGrid grid_10m() { return {{0, 50}, 10, 5, 10}; }

}  // namespace

// Energy grows with the distance from the start, so that it is exact also half-way between two
// frames.
TEST(LineSums, OfASlideAreTheClosedForm) {
  const Trn trn = plane_trn(slope, 5, 21, 11);
  const RunFile run = sliding_run({12, 25, 41}, 0.5);
  LineSums sums = start_line(line_of(trn, {{20, 0}, {70, 50}}, 5));
  add_run(sums, run, trn);
  finish(sums);
  ASSERT_EQ(sums.crossings.size(), 3u);
  EXPECT_EQ(sums.n_by_frames, 1);
  EXPECT_DOUBLE_EQ(sums.frame_interval, 0.5);
  for (const LineCrossing& crossing : sums.crossings) {
    const double y = run.blocks.rest[crossing.at.block].position.y(), way = (20 + y) / along_x;
    const double energy = 2000 * acceleration * way;
    EXPECT_NEAR(crossing.at.energy(), energy, 2e-6 * energy);
    EXPECT_NEAR(crossing.at.chainage, std::sqrt(2) * y, 1e-9);
    EXPECT_EQ(crossing.at.direction, -1);  // eastwards, to the right of a line to the north-east
    EXPECT_NEAR(crossing.at.time, std::sqrt(2 * way / acceleration), 0.02);
    EXPECT_NEAR(crossing.at.speed, std::sqrt(2 * acceleration * way), 0.02);
    EXPECT_NEAR(crossing.at.centroid, 1, 1e-9);
    EXPECT_NEAR(crossing.at.top, 1.5, 1e-6);
    EXPECT_NEAR(crossing.at.bottom, 0.5, 1e-6);
    EXPECT_GT(crossing.energy_change, 0);
    EXPECT_TRUE(crossing.at.passed_for_good);
    EXPECT_FALSE(crossing.by_cells);
  }
}

TEST(LineSums, KeepTheFirstCrossingAndCountReturns) {
  const Trn trn = plane_trn(0, 5, 21, 11);
  RunFile run;
  add_box(run, {1, 1, 1}, {10, 20, 101});
  double x = 10;
  for (const double to : {10.0, 30.0, 10.0, 30.0, 50.0}) {  // three times over x = 20
    x = to;
    FrameBlock at = standing({x, 20, 101});
    at.velocity = {4 + run.frames.time.size() * 1.0, 0, 0};
    add_frame(run, static_cast<double>(run.frames.time.size()), {at});
  }
  LineSums sums = start_line(line_of(trn, {{20, 10}, {20, 30}}, 5));
  add_run(sums, run, trn);
  ASSERT_EQ(sums.crossings.size(), 1u);
  EXPECT_EQ(sums.crossings[0].n_crossings, 3);
  EXPECT_DOUBLE_EQ(sums.crossings[0].at.time, 0.5);
  LineSums beside = start_line(line_of(trn, {{20, 21}, {20, 30}}, 5));
  add_run(beside, run, trn);
  EXPECT_TRUE(beside.crossings.empty());
}

// Two pieces of a block that breaks between two lines: at the first they are the block, with its
// place, height and energy, at the second each is itself.
TEST(LineSums, OfPiecesAreThoseOfTheirBlockUntilItBreaks) {
  const Trn trn = plane_trn(0, 5, 21, 11);
  RunFile run;
  add_box(run, {2, 1, 1}, {0, 20, 101});
  add_box(run, {1, 1, 3}, {1.5, 20, 101});
  for (int k = 0; k <= 40; ++k) {  // 10 m/s; after 2 s the second one is twice as fast
    const double t = 0.1 * k, late = std::max(0.0, t - 2.05);
    FrameBlock a = standing({10 * t, 20, 101}), b = standing({1.5 + 10 * t + 10 * late, 20, 101});
    a.velocity = {10, 0, 0};
    b.velocity = {t > 2.05 ? 20.0 : 10.0, 0, 0};
    add_frame(run, t, {a, b});
  }
  run.blocks.body = {4, 5};
  Break broken;
  broken.block = 0;
  broken.first_piece = 4;
  broken.time = 2.05;
  run.breaks = {broken};
  const double mass_a = 4000, mass_b = 6000;

  LineSums sums = start_line(line_of(trn, {{12, 10}, {12, 30}}, 5));
  add_run(sums, run, trn);
  finish(sums);
  ASSERT_EQ(sums.crossings.size(), 2u);
  for (const LineCrossing& crossing : sums.crossings) {
    EXPECT_NEAR(crossing.at.time, (12 - 0.6 * 1.5) / 10, 1e-9);  // when their common centre does
    EXPECT_NEAR(crossing.at.energy(), 0.5 * (mass_a + mass_b) * 100, 1e-3);
    EXPECT_NEAR(crossing.at.top, 2.5, 1e-6);
    EXPECT_NEAR(crossing.at.bottom, -0.5, 1e-6);
  }
  EXPECT_DOUBLE_EQ(sums.crossings[0].mass, mass_a);
  EXPECT_DOUBLE_EQ(sums.crossings[1].mass, mass_b);

  LineSums later = start_line(line_of(trn, {{32, 10}, {32, 30}}, 5));
  add_run(later, run, trn);
  finish(later);
  ASSERT_EQ(later.crossings.size(), 2u);
  EXPECT_NEAR(later.crossings[0].at.energy(), 0.5 * mass_a * 100, 1e-3);
  EXPECT_NEAR(later.crossings[1].at.energy(), 0.5 * mass_b * 400, 1e-3);
  EXPECT_NEAR(later.crossings[0].at.time, 3.2, 1e-9);
  EXPECT_NEAR(later.crossings[0].at.top, 1.5, 1e-6);
}

// Without frames a block counts once, where it first came over a cell of the line, with the largest
// of all of them; cells beside the line do not count.
TEST(LineSums, OfCellsAreTheLargestOverThem) {
  const Trn trn = plane_trn(slope, 5, 21, 11);
  RunFile run;
  add_box(run, {1, 1, 1}, {0, 25, 101});
  add_box(run, {1, 1, 1}, {0, 45, 101});
  add_frame(run, 8, {standing({50, 25, 80}), standing({0, 45, 101})});
  run.grid = grid_10m();
  run.passages = {passage(0, 22, 2, 700, 5, 2), passage(0, 24, 4, 900, 7, 1),
                  passage(0, 34, 3, 800, 6, 3), passage(1, 44, 5, 100, 1, 1)};
  LineSums sums = start_line(line_of(trn, {{45, 8}, {45, 36}}, 7));
  ASSERT_FALSE(has_frames(run));
  add_run(sums, run, trn);
  add_passages(sums, run, 0, {run.passages.begin(), run.passages.begin() + 2});
  add_passages(sums, run, 0, {run.passages.begin() + 2, run.passages.end()});
  finish(sums);
  ASSERT_EQ(sums.cells.size(), 4u);  // rows of y = 0, 10, 20, 30: the first one from y = 8
  EXPECT_EQ(sums.cells[0].cell, 44u);
  EXPECT_DOUBLE_EQ(sums.cells[0].to, 2);
  ASSERT_EQ(sums.crossings.size(), 2u);
  const LineCrossing& crossing = sums.crossings[0];
  EXPECT_TRUE(crossing.by_cells);
  EXPECT_DOUBLE_EQ(crossing.at.time, 3);
  EXPECT_NEAR(crossing.at.chainage, 7, 1e-12);  // cell 34 is that of y = 10 to 20
  EXPECT_DOUBLE_EQ(crossing.at.energy(), 900);
  EXPECT_DOUBLE_EQ(crossing.at.translation, 675);
  EXPECT_DOUBLE_EQ(crossing.at.speed, 7);
  EXPECT_DOUBLE_EQ(crossing.at.top, 3);
  EXPECT_NEAR(crossing.place.z(), 100 - slope * 45, 1e-9);
  EXPECT_EQ(method_text(sums), "cells");
  const std::vector<StationSummary> stations =
      station_summaries(sums, share_basis(clusters_of_runs({2}, 2)));
  ASSERT_EQ(stations.size(), 5u);
  EXPECT_DOUBLE_EQ(stations[0].energy.largest, 100);
  EXPECT_DOUBLE_EQ(stations[1].energy.largest, 800);  // y = 15
  EXPECT_DOUBLE_EQ(stations[2].top.largest, 1);       // y = 22
  EXPECT_DOUBLE_EQ(stations[3].share_of_runs, 1);
  EXPECT_TRUE(std::isnan(stations[4].energy.largest));  // y = 36: nothing came
  EXPECT_EQ(stations[4].share_of_runs, 0);
  EXPECT_NEAR(stations[4].place.z(), 100 - slope * 45, 1e-9);
  EXPECT_TRUE(std::isnan(stations[0].energy.p95));  // of one block
}

// With frames, passages only tell the profile along the line.
TEST(LineSums, OfFramesTakeNoCrossingsFromPassages) {
  const Trn trn = plane_trn(slope, 5, 21, 11);
  RunFile run = sliding_run({25, 45}, 0.1);
  run.grid = grid_10m();
  run.passages = {passage(0, 24, 4, 900, 7, 1), passage(1, 34, 4, 900, 7, 1)};
  LineSums sums = start_line(line_of(trn, {{45, 12}, {45, 36}}, 6));
  add_run(sums, run, trn);
  add_passages(sums, run, 0, run.passages);
  finish(sums);
  ASSERT_EQ(sums.crossings.size(), 1u);
  EXPECT_EQ(sums.crossings[0].at.block, 0);
  EXPECT_FALSE(sums.crossings[0].by_cells);
  EXPECT_EQ(sums.values.size(), 2u);
}

TEST(AcrossSummary, HasSharesOfRunsBlocksAndMass) {
  const Trn trn = plane_trn(slope, 5, 21, 11);
  LineSums sums = start_line(line_of(trn, {{45, 10}, {45, 50}}, 5));
  for (int r = 0; r < 12; ++r)  // in every third run nothing comes to the line, which begins at 10
    add_run(sums, r % 3 == 0 ? sliding_run({2, 4}, 0.1) : sliding_run({2, 12 + r * 1.0}, 0.1), trn);
  finish(sums);
  const ShareBasis basis = share_basis(clusters_of_runs(std::vector<double>(12, 2), 2));
  const AcrossSummary all = across_summary(sums, basis, 0, 40);
  EXPECT_EQ(all.blocks.n, 8);
  EXPECT_EQ(all.n_runs_hit, 8);
  EXPECT_NEAR(all.share_of_runs, 8.0 / 12, 1e-12);
  EXPECT_NEAR(all.share_of_blocks, 8.0 / 24, 1e-12);
  EXPECT_NEAR(all.share_of_mass, 8.0 / 24, 1e-12);
  EXPECT_NEAR(all.a_run, 8.0 / 12, 1e-12);
  EXPECT_NEAR(all.mass_a_run, 2000 * 8.0 / 12, 1e-9);
  const Interval wilson = wilson_interval(8.0 / 12, 12);
  EXPECT_NEAR(all.interval_of_runs.low, wilson.low, 1e-9);
  EXPECT_NEAR(all.interval_of_runs.high, wilson.high, 1e-9);
  const double energy = 2000 * acceleration * 45 / along_x;
  EXPECT_NEAR(all.blocks.energy.largest, energy, 2e-6 * energy);
  EXPECT_TRUE(std::isnan(all.blocks.energy.percentile[place_of_p95].value));  // of 8 blocks
  // each block is in one part: y = 13 to 23 is chainage 3 to 13
  int n = 0;
  const std::vector<double> limits = bin_limits(40, 3);
  for (std::size_t i = 0; i + 1 < limits.size(); ++i)
    n += across_summary(sums, basis, limits[i], limits[i + 1]).blocks.n;
  EXPECT_EQ(n, 8);
  EXPECT_EQ(across_summary(sums, basis, 3, 4).blocks.n, 1);
  const AcrossSummary empty = across_summary(sums, basis, 20, 30);
  EXPECT_EQ(empty.blocks.n, 0);
  EXPECT_EQ(empty.share_of_runs, 0);
  EXPECT_NEAR(empty.interval_of_runs.high, wilson_interval(0, 12).high, 1e-9);
  EXPECT_TRUE(std::isnan(empty.first_arrival));
}

TEST(AcrossSummary, WeighsRuns) {
  const Trn trn = plane_trn(slope, 5, 21, 11);
  LineSums sums = start_line(line_of(trn, {{45, 10}, {45, 50}}, 5));
  RunFile heavy = sliding_run({20}, 0.1), light = sliding_run({2}, 0.1);
  heavy.run_weight = 1.5;
  light.run_weight = 0.5;
  add_run(sums, heavy, trn);
  add_run(sums, light, trn);
  const ShareBasis basis = share_basis(clusters_of_runs({1.5, 0.5}, 1, {}, {1.5, 0.5}));
  const AcrossSummary all = across_summary(sums, basis, 0, 40);
  EXPECT_NEAR(all.share_of_runs, 0.75, 1e-12);
  EXPECT_NEAR(all.share_of_blocks, 0.75, 1e-12);
  EXPECT_NEAR(all.share_of_mass, 0.75, 1e-12);
  EXPECT_NEAR(all.a_run, 0.75, 1e-12);
}

TEST(EnergyChange, IsThatBetweenTheFrames) {
  const Trn trn = plane_trn(slope, 5, 21, 11);
  LineSums sums = start_line(line_of(trn, {{45, 10}, {45, 50}}, 5));
  add_run(sums, sliding_run({20}, 1), trn);
  ASSERT_EQ(sums.crossings.size(), 1u);
  // 45 / along_x = 50.3 m lies between 5 s (37.5 m) and 6 s (54 m)
  EXPECT_NEAR(energy_change(sums).p50, (54 - 37.5) / (45 / along_x), 1e-6);
}

TEST(BinLimits, AreRoundAndEndWithTheLine) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(bin_limits(7, 2), (std::vector<double>{0, 2, 4, 6, 7}));
  EXPECT_EQ(bin_limits(6, 2), (std::vector<double>{0, 2, 4, 6}));
  EXPECT_EQ(bin_limits(1, 5), (std::vector<double>{0, 1}));
  for (double length = 0.3; length < 1e5; length *= 1.07) {
    const std::size_t n = bin_limits(length, nan).size() - 1;
    EXPECT_GE(n, 10u) << length;
    EXPECT_LE(n, 25u) << length;
  }
}
