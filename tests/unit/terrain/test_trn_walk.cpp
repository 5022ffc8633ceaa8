// Cells crossed by a segment, against dense sampling.
#include <gtest/gtest.h>

#include <vector>

#include "random_trn.hpp"
#include "terrain/trn_walk.hpp"

namespace {

using talus::Cell;
using talus::CellPart;
using talus::Trn;
using talus::Vec2;

std::vector<CellPart> walk(const Trn& trn, const Vec2& a, const Vec2& b) {
  std::vector<CellPart> parts;
  talus::walk_cells(trn, a, b, [&](const CellPart& part) { parts.push_back(part); });
  return parts;
}

std::vector<Cell> cells(const std::vector<CellPart>& parts) {
  std::vector<Cell> list;
  for (const CellPart& part : parts) list.push_back(part.cell);
  return list;
}

void expect_contiguous(const std::vector<CellPart>& parts, double from, double to) {
  ASSERT_FALSE(parts.empty());
  EXPECT_EQ(parts.front().t_in, from);
  EXPECT_EQ(parts.back().t_out, to);
  for (std::size_t i = 0; i < parts.size(); ++i) EXPECT_LT(parts[i].t_in, parts[i].t_out);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    EXPECT_EQ(parts[i].t_in, parts[i - 1].t_out);
    EXPECT_LE(std::abs(parts[i].cell.row - parts[i - 1].cell.row), 1);
    EXPECT_LE(std::abs(parts[i].cell.col - parts[i - 1].cell.col), 1);
  }
}

TEST(WalkCells, AgreesWithDenseSampling) {
  talus::Random random(1, "walk");
  const Trn trn = talus_test::random_trn(random, 20, 30, 1);
  const double size = trn.cell_size;
  int n_parts = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const auto place = [&] {
      return Vec2(trn.node0.x() + random.uniform(0, 29) * size,
                  trn.node0.y() - random.uniform(0, 19) * size);
    };
    const Vec2 a = place();
    const Vec2 b = trial % 3 == 0 ? Vec2(a + 0.1 * (place() - a)) : place();
    const std::vector<CellPart> parts = walk(trn, a, b);
    expect_contiguous(parts, 0, 1);
    std::size_t part = 0;
    for (int sample = 0; sample < 2000; ++sample) {
      const double t = (sample + 0.5) / 2000;
      while (parts[part].t_out < t) ++part;
      const Vec2 at = a + t * (b - a);
      if (t - parts[part].t_in < 1e-9 || parts[part].t_out - t < 1e-9) continue;
      ASSERT_EQ(parts[part].cell, talus::locate(trn, at.x(), at.y()).cell);
    }
    n_parts += static_cast<int>(parts.size());
  }
  EXPECT_GT(n_parts, 4000);
}

TEST(WalkCells, LeavesOutWhatLiesOffTheGrid) {
  talus::Random random(2, "off");
  const Trn trn = talus_test::random_trn(random, 8, 9, 1);
  const double size = trn.cell_size;
  int n_missed = 0, n_crossed = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const auto place = [&] {
      return Vec2(trn.node0.x() + random.uniform(-8, 16) * size,
                  trn.node0.y() - random.uniform(-8, 15) * size);
    };
    const Vec2 a = place(), b = place();
    const std::vector<CellPart> parts = walk(trn, a, b);
    std::size_t part = 0;
    for (int sample = 0; sample < 500; ++sample) {
      const double t = (sample + 0.5) / 500;
      const Vec2 at = a + t * (b - a);
      while (part < parts.size() && parts[part].t_out < t) ++part;
      const bool covered = part < parts.size() && parts[part].t_in < t;
      ASSERT_EQ(covered, talus::contains(trn, at.x(), at.y()));
      if (covered) {
        ASSERT_EQ(parts[part].cell, talus::locate(trn, at.x(), at.y()).cell);
      }
    }
    if (parts.empty())
      ++n_missed;
    else
      expect_contiguous(parts, parts.front().t_in, parts.back().t_out), ++n_crossed;
  }
  EXPECT_GT(n_missed, 300);
  EXPECT_GT(n_crossed, 300);
}

// A grid of unit cells: corners and grid lines are hit exactly.
TEST(WalkCells, PassesCornersWithoutTouchingTheCellsBeside) {
  const Trn trn = talus_test::planar_trn(5, 5, 1, 0, 0);
  EXPECT_EQ(cells(walk(trn, {0.5, -0.5}, {3.5, -3.5})),
            (std::vector<Cell>{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
  EXPECT_EQ(cells(walk(trn, {3.5, -3.5}, {0.5, -0.5})),
            (std::vector<Cell>{{3, 3}, {2, 2}, {1, 1}, {0, 0}}));
  EXPECT_EQ(cells(walk(trn, {0.5, -3.5}, {3.5, -0.5})),
            (std::vector<Cell>{{3, 0}, {2, 1}, {1, 2}, {0, 3}}));
}

TEST(WalkCells, RunsAlongGridLinesInTheCellToTheEastAndSouth) {
  const Trn trn = talus_test::planar_trn(5, 5, 1, 0, 0);
  EXPECT_EQ(cells(walk(trn, {2, -0.5}, {2, -2.5})), (std::vector<Cell>{{0, 2}, {1, 2}, {2, 2}}));
  EXPECT_EQ(cells(walk(trn, {2.5, -2}, {0.5, -2})), (std::vector<Cell>{{2, 2}, {2, 1}, {2, 0}}));
  // the eastern and the southern border have no cell beyond: they belong to the last one
  EXPECT_EQ(cells(walk(trn, {4, 0}, {4, -2})), (std::vector<Cell>{{0, 3}, {1, 3}}));
  EXPECT_EQ(cells(walk(trn, {0, -4}, {2, -4})), (std::vector<Cell>{{3, 0}, {3, 1}}));
}

TEST(WalkCells, StopsAtTheLineWhereTheSegmentEnds) {
  const Trn trn = talus_test::planar_trn(5, 5, 1, 0, 0);
  EXPECT_EQ(cells(walk(trn, {0.25, -0.5}, {2, -0.5})), (std::vector<Cell>{{0, 0}, {0, 1}}));
  EXPECT_EQ(cells(walk(trn, {2, -0.5}, {0.25, -0.5})), (std::vector<Cell>{{0, 1}, {0, 0}}));
  EXPECT_EQ(cells(walk(trn, {1, -1}, {2, -2})), (std::vector<Cell>{{1, 1}}));
}

TEST(WalkCells, ASegmentWithoutExtentVisitsItsCellOnce) {
  const Trn trn = talus_test::planar_trn(5, 5, 1, 0, 0);
  const std::vector<CellPart> parts = walk(trn, {1, -1.5}, {1, -1.5});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].cell, (Cell{1, 1}));
  EXPECT_EQ(parts[0].t_in, 0);
  EXPECT_EQ(parts[0].t_out, 1);
  EXPECT_TRUE(walk(trn, {-1, -1.5}, {-1, -1.5}).empty());
}

// Cutting a segment where it meets grid lines neither adds nor loses cells.
TEST(WalkCells, PartsOfACutSegmentMakeTheWholeOne) {
  talus::Random random(3, "cut");
  const Trn trn = talus_test::planar_trn(17, 17, 1, 0, 0);
  const auto lattice = [&] { return static_cast<double>(random.below(17)); };
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec2 a(lattice(), -lattice()), b(lattice(), -lattice());
    if (a == b) continue;
    const Vec2 middle = 0.5 * (a + b);  // exact in binary
    std::vector<Cell> halves = cells(walk(trn, a, middle));
    for (const Cell& cell : cells(walk(trn, middle, b)))
      if (halves.empty() || !(halves.back() == cell)) halves.push_back(cell);
    EXPECT_EQ(halves, cells(walk(trn, a, b)));
  }
}

}  // namespace
