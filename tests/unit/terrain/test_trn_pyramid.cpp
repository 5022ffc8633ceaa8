// Ranges of elevations and candidate cells.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "random_trn.hpp"
#include "terrain/trn_pyramid.hpp"

namespace {

using talus::CellRange;
using talus::ElevationRange;
using talus::Reach;
using talus::Trn;
using talus::Vec3;

ElevationRange brute_force_range(const Trn& trn, const CellRange& cells) {
  ElevationRange found;
  for (int r = cells.row_first; r <= cells.row_last + 1; ++r)
    for (int c = cells.col_first; c <= cells.col_last + 1; ++c) {
      const double z = talus::node_point(trn, r, c).z();
      if (std::isnan(z)) found.all_known = false;
      if (z < found.low) found.low = z;
      if (z > found.high) found.high = z;
    }
  return found;
}

CellRange random_range(talus::Random& random, const Trn& trn) {
  const auto pick = [&](int n) {
    return static_cast<int>(random.below(static_cast<std::uint64_t>(n)));
  };
  CellRange range{pick(trn.n_rows - 1), pick(trn.n_rows - 1), pick(trn.n_cols - 1),
                  pick(trn.n_cols - 1)};
  if (range.row_first > range.row_last) std::swap(range.row_first, range.row_last);
  if (range.col_first > range.col_last) std::swap(range.col_first, range.col_last);
  return range;
}

TEST(TrnPyramid, RangesAreThoseOfAllNodes) {
  talus::Random random(1, "ranges");
  for (const double unknown : {0.0, 0.02, 0.9})
    for (const auto& [rows, cols] : {std::pair(2, 2), std::pair(9, 9), std::pair(17, 40),
                                     std::pair(131, 70), std::pair(200, 3)}) {
      const Trn trn = talus_test::random_trn(random, rows, cols, 100, unknown);
      const talus::TrnPyramid pyramid = talus::build_pyramid(trn);
      EXPECT_EQ(pyramid.levels.back().tiles.size(), 1u);
      for (int trial = 0; trial < 300; ++trial) {
        const CellRange range = random_range(random, trn);
        EXPECT_EQ(talus::elevation_range(trn, pyramid, range), brute_force_range(trn, range));
      }
    }
}

// A triangle touches a box in plan when no axis of x, y and the diagonal separates them.
bool touches(const std::array<Vec3, 3>& corner, const Vec3& low, const Vec3& high) {
  const auto separated = [&](double ax, double ay) {
    double t_low = 1e300, t_high = -1e300, b_low = 1e300, b_high = -1e300;
    for (const Vec3& p : corner) {
      t_low = std::min(t_low, ax * p.x() + ay * p.y());
      t_high = std::max(t_high, ax * p.x() + ay * p.y());
    }
    for (const double x : {low.x(), high.x()})
      for (const double y : {low.y(), high.y()}) {
        b_low = std::min(b_low, ax * x + ay * y);
        b_high = std::max(b_high, ax * x + ay * y);
      }
    return t_high < b_low || b_high < t_low;
  };
  return !separated(1, 0) && !separated(0, 1) && !separated(1, 1);
}

// Eq. (5) and (6) against a look at every triangle: none that the enlarged box touches is missed,
// and no cell is named that it does not touch.
TEST(CellsNear, AreTheCellsThatTheEnlargedBoxTouches) {
  talus::Random random(2, "candidates");
  const Trn trn = talus_test::random_trn(random, 12, 15, 10);
  const double size = trn.cell_size;
  int n_off = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double ctol = random.uniform(0, 0.5 * size);
    const Vec3 low(trn.node0.x() + random.uniform(-4, 17) * size,
                   trn.node0.y() - random.uniform(-4, 14) * size, 0);
    const Vec3 high = low + Vec3(random.uniform(0, 4) * size, random.uniform(0, 4) * size, 1);
    const Vec3 reach(ctol, ctol, 0);
    const CellRange range = talus::cells_near(trn, low, high, ctol);
    std::set<int> expected, found;
    for (int t = 0; t < talus::n_triangles(trn); ++t)
      if (touches(talus::triangle_corners(trn, t), low - reach, high + reach))
        expected.insert(t / 2);
    for (int r = range.row_first; r <= range.row_last; ++r)
      for (int c = range.col_first; c <= range.col_last; ++c)
        found.insert(talus::first_triangle(trn, {r, c}) / 2);
    EXPECT_EQ(found, expected);
    n_off += range.empty();
  }
  EXPECT_GT(n_off, 100);
  EXPECT_LT(n_off, 1500);
}

TEST(CellsNear, FloorKeepsABlockJustOffTheEdgeOff) {
  const Trn trn = talus_test::planar_trn(5, 5, 10, 0, 0);
  EXPECT_TRUE(talus::cells_near(trn, {-3, -20, 0}, {-1, -10, 1}, 0.5).empty());
  EXPECT_EQ(talus::cells_near(trn, {-3, -20, 0}, {-1, -10, 1}, 1.5), (CellRange{0, 2, 0, 0}));
  EXPECT_TRUE(talus::cells_near(trn, {std::nan(""), -20, 0}, {1, -10, 1}, 0.5).empty());
}

TEST(IsPlane, SeesEveryNodeThatIsOffAndEveryUnknownOne) {
  Trn trn = talus_test::planar_trn(9, 11, 2.5, 0.31, -0.17);
  const CellRange range{2, 5, 3, 8};  // nodes of rows 2 to 6, columns 3 to 9
  for (const double x : {10.1, 14.9, 19.6}) {
    const talus::GridPoint point = talus::locate(trn, x, -9.3);
    EXPECT_TRUE(talus::is_plane(trn, range, point));
    for (int r = 0; r < trn.n_rows; ++r)
      for (int c = 0; c < trn.n_cols; ++c) {
        const bool is_in = r >= 2 && r <= 6 && c >= 3 && c <= 9;
        double& z = trn.elevation[talus::node_index(trn, r, c)];
        for (const double off : {1e-5, -1e-5, std::nan("")}) {
          const double was = z;
          z += off;
          EXPECT_EQ(talus::is_plane(trn, range, point), !is_in) << r << " " << c;
          z = was;
        }
      }
  }
}

TEST(FindNearCells, Equation7TellsAboveFromPossibleAndBelow) {
  talus::Random random(3, "eq7");
  Trn trn = talus_test::random_trn(random, 60, 60, 50, 0.1);
  const talus::TrnPyramid pyramid = talus::build_pyramid(trn);
  int n_of[4] = {};
  for (int trial = 0; trial < 5000; ++trial) {
    const double ctol = random.uniform(0, 1);
    const Vec3 low(trn.node0.x() + random.uniform(-30, 320),
                   trn.node0.y() - random.uniform(-30, 320), random.uniform(-20, 70));
    const Vec3 high =
        low + Vec3(random.uniform(0, 90), random.uniform(0, 30), random.uniform(0, 9));
    const talus::NearCells near = talus::find_near_cells(trn, pyramid, low, high, ctol);
    const ElevationRange ground = brute_force_range(trn, near.cells);
    Reach expected = Reach::possible;
    if (near.cells.empty() || ground.low > ground.high)
      expected = Reach::off_ground;
    else if (low.z() - ctol >= ground.high)
      expected = Reach::above;
    else if (high.z() + ctol < ground.low)
      expected = Reach::below;
    EXPECT_EQ(near.reach, expected);
    ++n_of[static_cast<int>(expected)];
  }
  for (const int n : n_of) EXPECT_GT(n, 100);
}

TEST(FindNearCells, OverUnknownGroundABlockIsOffTheGround) {
  Trn trn = talus_test::planar_trn(8, 8, 1, 0, 0);
  for (int r = 0; r < 8; ++r)
    for (int c = 4; c < 8; ++c) trn.elevation[talus::node_index(trn, r, c)] = std::nan("");
  const talus::TrnPyramid pyramid = talus::build_pyramid(trn);
  EXPECT_EQ(talus::find_near_cells(trn, pyramid, {5.2, -3, 0}, {6, -2, 1}, 0.1).reach,
            Reach::off_ground);
  const talus::NearCells rim =
      talus::find_near_cells(trn, pyramid, {2.2, -3, 999.5}, {3.5, -2, 1001}, 0.1);
  EXPECT_EQ(rim.reach, Reach::possible);
  EXPECT_FALSE(rim.ground.all_known);
}

}  // namespace
