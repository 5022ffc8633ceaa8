// Deposits: volumes in cells, balance, outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.hpp"
#include "geometry/polyhedron.hpp"
#include "post/outline.hpp"
#include "run_maker.hpp"

using namespace talus;
using namespace talus::testing;

namespace {

const PassageGrid grid{Vec2(-20, 20), 2, 20, 20};

double sum_of(const std::map<std::uint32_t, double>& values) {
  double sum = 0;
  for (const auto& [cell, value] : values) sum += value;
  return sum;
}

Quat random_attitude(Random& random) {
  return Quat(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
}

double area_of(const std::vector<Vec2>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += (a.x() * b.y() - a.y() * b.x()) / 2;
  }
  return sum;
}

}  // namespace

// A box that lies straight: over each cell it has its own share of the area times its height.
TEST(AddVolume, OfAStraightBoxIsAreaTimesHeight) {
  RunFile run;
  add_box(run, {5, 3, 2}, {0.5, 0.25, 100});
  std::map<std::uint32_t, double> volume;
  add_volume(volume, grid, run, 0, run.blocks.rest[0]);
  // x from -2 to 3, y from -1.25 to 1.75: columns 9..11, rows 9 and 10
  const auto at = [&volume](int row, int col) {
    return volume[static_cast<unsigned>(row * 20 + col)];
  };
  EXPECT_NEAR(at(9, 9), 2 * 1.75 * 2, 1e-12);
  EXPECT_NEAR(at(9, 11), 1 * 1.75 * 2, 1e-12);
  EXPECT_NEAR(at(10, 10), 2 * 1.25 * 2, 1e-12);
  EXPECT_NEAR(sum_of(volume), 30, 1e-12);
}

// At any attitude: the cells' volumes add up to the block's, none is negative, and each one equals
// that of the body cut at its cell's four sides.
TEST(AddVolume, EqualsTheBodyCutAtTheCellsSides) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    RunFile run;
    const Vec3 size(random.uniform(0.5, 8), random.uniform(0.5, 8), random.uniform(0.5, 8));
    add_box(run, size, Vec3::Zero());
    const Pose pose{{random.uniform(-5, 5), random.uniform(-5, 5), 1000}, random_attitude(random)};
    std::map<std::uint32_t, double> volume;
    add_volume(volume, grid, run, 0, pose);
    EXPECT_NEAR(sum_of(volume), size.prod(), 1e-9);
    for (const auto& [cell, found] : volume) {
      const Vec2 nw = grid.corner + 2 * Vec2(cell % 20, -static_cast<double>(cell / 20));
      Polyhedron body = box(-0.5 * size, 0.5 * size);
      for (Vec3& v : body.vertices)
        v = pose.attitude * v + Vec3(pose.position.x(), pose.position.y(), 0);
      for (const auto& [normal, d] : {std::pair<Vec3, double>{{1, 0, 0}, nw.x() + 2},
                                      {{-1, 0, 0}, -nw.x()},
                                      {{0, 1, 0}, nw.y()},
                                      {{0, -1, 0}, -nw.y() + 2}})
        body = clip_convex(body, {normal, d}, 0, 1e-12);
      EXPECT_NEAR(found, n_faces(body) > 0 ? moments(body).volume : 0, 1e-9);
    }
  }
}

TEST(Footprint, IsTheConvexOutlineCounterClockwise) {
  RunFile run;
  add_box(run, {4, 2, 6}, {1, 1, 0});
  const auto ring = footprint(run, 0, run.blocks.rest[0]);
  EXPECT_EQ(ring.size(), 4U);
  EXPECT_DOUBLE_EQ(area_of(ring), 8);
  const Pose turned{{0, 0, 0}, Quat(Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitX()))};
  EXPECT_NEAR(area_of(footprint(run, 0, turned)), 4 * (2 + 6) / std::sqrt(2), 1e-12);
}

// Three boxes: one rests, one moves, one has left: the balance closes in number and volume.
TEST(Balance, ClosesOverAllFates) {
  RunFile run;
  for (const double edge : {1.0, 2.0, 3.0}) add_box(run, {edge, edge, edge}, {0, 0, 0});
  FrameBlock moving = standing({5, 5, 5});
  moving.velocity = {0, 0, -2};
  add_frame(run, 0, {standing({0, 0, 0}), standing({3, 0, 0}), standing({0, 0, 9})});
  add_frame(run, 1, {standing({1, 1, 1}), moving, standing({90, 0, 0})});
  run.phase = {Phase::near_ground, Phase::flight, Phase::left_domain};
  const Balance b = balance_of(run, 0.05);
  EXPECT_EQ(b.n_released, 3);
  EXPECT_EQ(b.n_deposited, 1);
  EXPECT_EQ(b.n_moving, 1);
  EXPECT_EQ(b.n_left, 1);
  EXPECT_DOUBLE_EQ(b.deposited, 1);
  EXPECT_DOUBLE_EQ(b.moving, 8);
  EXPECT_DOUBLE_EQ(b.left, 27);
  EXPECT_DOUBLE_EQ(b.released, b.deposited + b.moving + b.left);
}

// Thickness times area over all cells is the deposited volume, shared by the runs.
TEST(DepositLayer, HoldsTheDepositedVolume) {
  Random random(2);
  DepositSums sums;
  double volume = 0;
  for (int r = 0; r < 3; ++r) {
    RunFile run;
    std::vector<FrameBlock> frame;
    for (int i = 0; i < 4; ++i) {
      const Vec3 size(random.uniform(1, 4), random.uniform(1, 4), random.uniform(1, 4));
      add_box(run, size, {0, 0, 0});
      volume += size.prod();
      FrameBlock at = standing({random.uniform(-9, 9), random.uniform(-9, 9), 50});
      at.attitude = random_attitude(random);
      frame.push_back(at);
    }
    add_frame(run, 0, frame);
    add_deposit(sums, grid, run, 0.05);
  }
  const MapLayer layer =
      deposit_layer(sums, grid.cell_size, share_basis(clusters_of_runs({4, 4, 4}, 4)));
  double count = 0, fraction = 0, thickness = 0;
  for (std::size_t i = 0; i < layer.cell.size(); ++i) {
    count += layer.bands[0].value[i];
    fraction += layer.bands[1].value[i];
    thickness += layer.bands[2].value[i];
  }
  EXPECT_EQ(count, 12);
  EXPECT_NEAR(fraction, 1, 1e-6);
  EXPECT_NEAR(thickness * 4 * 3, volume, 1e-4 * volume);
}

// Rock that stays where it was cut is not a deposit where only moved rock counts.
TEST(DepositLayer, LeavesOutWhatDidNotMoveFarEnough) {
  RunFile run;
  for (int i = 0; i < 3; ++i) add_box(run, {2, 2, 2}, {0, 0, 0});
  add_frame(run, 0, {standing({0, 0, 0}), standing({0.6, 0, 0.8}), standing({0, 3, -4})});
  const auto count = [&run](double least) {
    DepositSums sums;
    add_deposit(sums, grid, run, 0.05, least);
    double n = 0, volume = 0;
    for (const auto& [cell, value] : sums.count) n += value;
    for (const auto& [cell, value] : sums.volume) volume += value;
    EXPECT_NEAR(volume, 8 * n, 1e-9);
    return n;
  };
  EXPECT_EQ(count(-1), 3);
  EXPECT_EQ(count(0), 2);
  EXPECT_EQ(count(1), 1);  // displaced by 1 m: not more
  EXPECT_EQ(count(5), 0);
}

// A ring of cells with a hole, a cell apart, and one that only meets it in a corner.
TEST(Outline, KeepsHolesAndPartsCellsThatMeetInACorner) {
  const PassageGrid small{Vec2(0, 5), 1, 5, 5};
  const std::vector<std::uint32_t> cells = {0, 1, 2, 5, 7, 10, 11, 12, 18, 24};
  const auto polygons = outline(small, cells);
  ASSERT_EQ(polygons.size(), 3U);
  ASSERT_EQ(polygons[0].size(), 2U);
  EXPECT_DOUBLE_EQ(area_of(polygons[0][0]), 9);
  EXPECT_DOUBLE_EQ(area_of(polygons[0][1]), -1);
  EXPECT_EQ(polygons[0][0].size(), 4U);
  EXPECT_DOUBLE_EQ(area_of(polygons[1][0]), 1);
  EXPECT_DOUBLE_EQ(area_of(polygons[2][0]), 1);
}

TEST(Outline, OfRandomCellsHasTheirAreaInSimpleRings) {
  Random random(4);
  const PassageGrid small{Vec2(0, 12), 1, 12, 12};
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<std::uint32_t> cells;
    for (std::uint32_t cell = 0; cell < 144; ++cell)
      if (random.uniform() < 0.6) cells.push_back(cell);
    double area = 0;
    for (const auto& rings : outline(small, cells)) {
      EXPECT_GT(area_of(rings[0]), 0);
      for (const auto& ring : rings) area += area_of(ring);
      for (std::size_t i = 1; i < rings.size(); ++i) EXPECT_LT(area_of(rings[i]), 0);
      auto points = rings[0];  // an outer ring never meets itself
      std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
        return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
      });
      EXPECT_EQ(std::adjacent_find(points.begin(), points.end()), points.end());
    }
    EXPECT_NEAR(area, static_cast<double>(cells.size()), 1e-9);
  }
}
