// TINs on grids, against locating every node.
#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"
#include "terrain/grid_tin.hpp"

namespace {

using talus::GridFrame;
using talus::Tin;
using talus::Vec3;

// A lattice of points moved by up to `jitter` of its spacing (below 1/4, so that quadrangles stay
// convex), with triangles turned to and fro.
Tin jittered_tin(talus::Random& random, int n, double jitter) {
  Tin tin;
  tin.origin = {500'000, 5'200'000, 100};
  for (int r = 0; r < n; ++r)
    for (int c = 0; c < n; ++c)
      tin.points.emplace_back(10 * (c + jitter * random.uniform(-1, 1)),
                              10 * (r + jitter * random.uniform(-1, 1)), random.uniform(0, 50));
  for (int r = 0; r + 1 < n; ++r)
    for (int c = 0; c + 1 < n; ++c) {
      const int sw = r * n + c, se = sw + 1, nw = sw + n, ne = nw + 1;
      if (random.uniform() < 0.5) {
        tin.triangles.push_back({sw, se, ne});
        tin.triangles.push_back({sw, ne, nw});
      } else {
        tin.triangles.push_back({sw, se, nw});
        tin.triangles.push_back({se, ne, nw});
      }
    }
  return tin;
}

// Elevation above map (x, y) by barycentric coordinates in every triangle in turn.
double brute_force(const Tin& tin, double x, double y) {
  for (const auto& [i, j, k] : tin.triangles) {
    const Vec3 a = tin.points[static_cast<std::size_t>(i)] + tin.origin;
    const Vec3 b = tin.points[static_cast<std::size_t>(j)] + tin.origin;
    const Vec3 c = tin.points[static_cast<std::size_t>(k)] + tin.origin;
    const double area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    const double w1 = ((x - a.x()) * (c.y() - a.y()) - (y - a.y()) * (c.x() - a.x())) / area;
    const double w2 = ((b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x())) / area;
    if (w1 >= 0 && w2 >= 0 && w1 + w2 <= 1)
      return a.z() + w1 * (b.z() - a.z()) + w2 * (c.z() - a.z());
  }
  return std::nan("");
}

GridFrame frame_around(const Tin& tin, double cell_size) {
  talus::MapWindow window = talus::extent(tin);
  window = {window.x_min - 15, window.y_min - 15, window.x_max + 15, window.y_max + 15};
  return talus::frame_inside(window, cell_size);
}

TEST(GridTin, AgreesWithLocatingEveryNode) {
  talus::Random random(1, "grid_tin");
  for (const double cell_size : {0.73, 3.3, 40.0}) {
    const Tin tin = jittered_tin(random, 9, 0.24);
    const GridFrame frame = frame_around(tin, cell_size);
    const std::vector<double> z = talus::grid_tin(tin, frame);
    int n_inside = 0, n_outside = 0;
    for (int r = 0; r < frame.n_rows; ++r)
      for (int c = 0; c < frame.n_cols; ++c) {
        const double expected = brute_force(tin, frame.x(c), frame.y(r));
        const double found = z[static_cast<std::size_t>(r * frame.n_cols + c)];
        ASSERT_EQ(std::isnan(found), std::isnan(expected)) << r << ' ' << c;
        if (std::isnan(expected)) {
          ++n_outside;
          continue;
        }
        EXPECT_NEAR(found, expected, 1e-6);  // 1e-9 m in map coordinates on slopes of up to 1000
        ++n_inside;
      }
    EXPECT_GT(n_inside, 1);
    EXPECT_GT(n_outside, 1);
  }
}

// Nodes on vertices and edges of the TIN, the outer ones included, belong to it.
TEST(GridTin, NodesOnVerticesAndEdgesAreInsideAndExact) {
  talus::Random random(2, "lattice");
  const Tin tin = jittered_tin(random, 7, 0);
  const GridFrame frame = talus::frame_inside(talus::extent(tin), 5);
  ASSERT_EQ(frame.n_rows, 13);
  ASSERT_EQ(frame.n_cols, 13);
  const std::vector<double> z = talus::grid_tin(tin, frame);
  for (int r = 0; r < 13; ++r)
    for (int c = 0; c < 13; ++c) {
      const double found = z[static_cast<std::size_t>(r * 13 + c)];
      ASSERT_FALSE(std::isnan(found)) << r << ' ' << c;
      if (r % 2 == 0 && c % 2 == 0) {
        const auto point = static_cast<std::size_t>((12 - r) / 2 * 7 + c / 2);
        EXPECT_EQ(found, tin.points[point].z() + 100);
      }
    }
}

TEST(GridTin, APlaneStaysAPlane) {
  talus::Random random(3, "plane");
  Tin tin = jittered_tin(random, 12, 0.24);
  for (Vec3& p : tin.points) p.z() = 300 + 0.7 * p.x() - 0.2 * p.y();
  const GridFrame frame = frame_around(tin, 1);
  const std::vector<double> z = talus::grid_tin(tin, frame);
  int n = 0;
  for (int r = 0; r < frame.n_rows; ++r)
    for (int c = 0; c < frame.n_cols; ++c) {
      const double found = z[static_cast<std::size_t>(r * frame.n_cols + c)];
      if (std::isnan(found)) continue;
      const double x = frame.x(c) - tin.origin.x(), y = frame.y(r) - tin.origin.y();
      EXPECT_NEAR(found, 400 + 0.7 * x - 0.2 * y, 1e-9);
      ++n;
    }
  EXPECT_GT(n, 8000);
}

// A fan of slivers, a millionth of a metre wide at its base, between 0 and 1 m of height.
TEST(GridTin, SlendersNeverOvershootTheirCorners) {
  Tin tin;
  tin.points = {{0, 0, 0}};
  for (int i = 0; i <= 50; ++i) tin.points.emplace_back(100, 30 + 1e-6 * i, i % 2);
  for (int i = 1; i <= 50; ++i) tin.triangles.push_back({0, i, i + 1});
  const std::vector<double> z = talus::grid_tin(tin, talus::frame_inside({0, 0, 100, 60}, 1));
  int n = 0;
  for (const double value : z) {
    if (std::isnan(value)) continue;
    EXPECT_GE(value, -1e-15);
    EXPECT_LE(value, 1 + 1e-15);
    ++n;
  }
  EXPECT_GE(n, 10);  // the nodes (10 k, 3 k)
}

TEST(GridTin, FlatTrianglesGiveExactlyTheirHeight) {
  talus::Random random(4, "flat");
  Tin tin = jittered_tin(random, 6, 0.24);
  for (Vec3& p : tin.points) p.z() = 412.37;
  tin.origin.z() = 0;
  for (const double z : talus::grid_tin(tin, frame_around(tin, 0.9))) {
    if (!std::isnan(z)) {
      EXPECT_EQ(z, 412.37);
    }
  }
}

// The far side of the Earth, and a grid between two nodes of which the TIN fits.
TEST(GridTin, AGridThatMissesTheTinIsUnknown) {
  talus::Random random(5, "miss");
  const Tin tin = jittered_tin(random, 3, 0);
  for (const GridFrame& frame :
       {GridFrame{3, 4, 1, {-2e7, 9e6}}, GridFrame{2, 2, 1e-3, {9e6, -2e7}},
        GridFrame{2, 2, 1e4, {495'000, 5'205'000}}})
    for (const double z : talus::grid_tin(tin, frame)) EXPECT_TRUE(std::isnan(z));
}

// Triangles that share edges have one height at each node; overlapping ones have two.
TEST(GridTin, ASecondLayerIsFound) {
  talus::Random random(7, "layers");
  Tin tin = jittered_tin(random, 9, 0.24);
  const GridFrame frame = frame_around(tin, 0.9);
  talus::TwoHeights two;
  const std::vector<double> below = talus::grid_tin(tin, frame, {}, &two);
  EXPECT_EQ(two.n, 0);
  const auto [i, j, k] = tin.triangles[20];
  const int first = static_cast<int>(tin.points.size());
  for (const int corner : {i, j, k})
    tin.points.emplace_back(tin.points[static_cast<std::size_t>(corner)] + Vec3(0, 0, 7));
  tin.triangles.push_back({first, first + 1, first + 2});
  const std::vector<double> above = talus::grid_tin(tin, frame, {}, &two);
  int n_changed = 0;
  for (std::size_t node = 0; node < above.size(); ++node)
    if (above[node] > below[node] + 6.9) ++n_changed;
  EXPECT_EQ(two.n, n_changed);
  EXPECT_GT(n_changed, 20);
  EXPECT_NEAR(two.z - two.other, 7, 1e-9);
}

TEST(GridTin, NaturalCellSizeIsNearTheDistanceOfThePoints) {
  talus::Random random(6, "size");
  EXPECT_EQ(talus::natural_cell_size(jittered_tin(random, 9, 0.24)), 5);  // 8.9 m
}

}  // namespace
