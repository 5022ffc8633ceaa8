// The TRN: counts, numbering, elevations, normals.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "random_trn.hpp"
#include "terrain/trn.hpp"

namespace {

using talus::Trn;
using talus::Vec3;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Trn grid(int n_rows, int n_cols) {
  Trn trn;
  trn.n_rows = n_rows;
  trn.n_cols = n_cols;
  trn.cell_size = 1;
  trn.elevation.assign(static_cast<std::size_t>(n_rows * n_cols), 0);
  return trn;
}

// Height of a triangle above (x, y) by barycentric coordinates; NaN when (x, y) is outside.
double height_in(const std::array<Vec3, 3>& corner, double x, double y) {
  const auto cross = [](const Vec3& a, const Vec3& b, double px, double py) {
    return (b.x() - a.x()) * (py - a.y()) - (b.y() - a.y()) * (px - a.x());
  };
  const double area = cross(corner[0], corner[1], corner[2].x(), corner[2].y());
  const double w0 = cross(corner[1], corner[2], x, y) / area;
  const double w1 = cross(corner[2], corner[0], x, y) / area;
  const double w2 = 1 - w0 - w1;
  if (std::min({w0, w1, w2}) < 0) return nan;
  return w0 * corner[0].z() + w1 * corner[1].z() + w2 * corner[2].z();
}

// The paper's example, a 570 x 455 matrix.
TEST(Trn, CountsOfThePaper) {
  const talus::FeatureCounts terrain = talus::feature_counts(grid(570, 455));
  EXPECT_EQ(terrain, (talus::FeatureCounts{259'350, 776'001, 516'652}));
  EXPECT_EQ(talus::n_triangles(grid(570, 455)), 516'652);
  EXPECT_EQ(talus::n_triangles(grid(29, 41)), 2'240);
}

TEST(Trn, TrianglesAreNumberedAsInThePaperAndTurnCounterClockwise) {
  talus::Random random(1, "numbering");
  const Trn trn = talus_test::random_trn(random, 5, 7, 20);
  int expected = 0;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 6; ++c)
      for (int half = 0; half < 2; ++half, ++expected) {
        const int triangle = talus::first_triangle(trn, {r, c}) + half;
        EXPECT_EQ(triangle, expected);
        EXPECT_EQ(talus::cell_of_triangle(trn, triangle), (talus::Cell{r, c}));
        const auto corner = talus::triangle_corners(trn, triangle);
        const Vec3 normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
        EXPECT_NEAR(normal.z(), trn.cell_size * trn.cell_size, 1e-12);
        const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3;
        EXPECT_EQ(talus::triangle_at(trn, middle.x(), middle.y()), triangle);
      }
}

TEST(Trn, PlaneHoldsTheCornersWithAnUpwardUnitNormal) {
  talus::Random random(2, "plane");
  const Trn trn = talus_test::random_trn(random, 6, 6, 50);
  for (int triangle = 0; triangle < talus::n_triangles(trn); ++triangle) {
    const talus::TrianglePlane plane = talus::triangle_plane(trn, triangle);
    EXPECT_NEAR(plane.normal.norm(), 1, 1e-15);
    EXPECT_GT(plane.normal.z(), 0);
    for (const Vec3& corner : talus::triangle_corners(trn, triangle))
      EXPECT_NEAR(plane.normal.dot(corner - plane.point), 0, 1e-13);
  }
}

TEST(Trn, ElevationIsThatOfTheTriangleThatHoldsThePoint) {
  talus::Random random(3, "elevation");
  const Trn trn = talus_test::random_trn(random, 9, 8, 30);
  const double width = 7 * trn.cell_size, height = 8 * trn.cell_size;
  for (int trial = 0; trial < 3000; ++trial) {
    const double x = trn.node0.x() + random.uniform(0, width);
    const double y = trn.node0.y() - random.uniform(0, height);
    double brute_force = nan;
    for (int triangle = 0; triangle < talus::n_triangles(trn) && std::isnan(brute_force);
         ++triangle)
      brute_force = height_in(talus::triangle_corners(trn, triangle), x, y);
    ASSERT_FALSE(std::isnan(brute_force));
    EXPECT_NEAR(talus::elevation_at(trn, x, y), brute_force, 1e-12);
  }
}

TEST(Trn, ElevationAtANodeIsTheNodesOwn) {
  talus::Random random(4, "node");
  Trn trn = talus_test::random_trn(random, 7, 9, 30);
  trn.cell_size = 2.5;  // exact in binary, so that the node is hit exactly
  for (int r = 0; r < trn.n_rows; ++r)
    for (int c = 0; c < trn.n_cols; ++c) {
      const Vec3 node = talus::node_point(trn, r, c);
      const double found = talus::elevation_at(trn, node.x(), node.y());
      if (r < trn.n_rows - 1 && c < trn.n_cols - 1)
        EXPECT_EQ(found, node.z());
      else
        EXPECT_NEAR(found, node.z(), 1e-13);
    }
}

// The paper's INT gives cell 0 to a point just west or north of the grid.
TEST(Trn, PointsOffTheGridAreClampedForLookupAndHaveNoElevation) {
  const Trn trn = talus_test::planar_trn(4, 5, 10, 0.1, 0);
  EXPECT_FALSE(talus::contains(trn, -0.3, -5));
  EXPECT_TRUE(std::isnan(talus::elevation_at(trn, -0.3, -5)));
  EXPECT_EQ(talus::locate(trn, -0.3, 0.3).cell, (talus::Cell{0, 0}));
  EXPECT_LT(talus::locate(trn, -0.3, 0.3).east, 0);
  EXPECT_EQ(talus::locate(trn, 1e9, -1e9).cell, (talus::Cell{2, 3}));
  EXPECT_TRUE(talus::contains(trn, 40, -30));
  EXPECT_EQ(talus::locate(trn, 40, -30).cell, (talus::Cell{2, 3}));
  EXPECT_NEAR(talus::elevation_at(trn, 40, -30), 1004, 1e-12);
  EXPECT_FALSE(talus::contains(trn, nan, -5));
}

TEST(Trn, TriangleWithAnUnknownCornerIsNoGround) {
  talus::Random random(5, "unknown");
  const Trn trn = talus_test::random_trn(random, 12, 12, 30, 0.3);
  int n_known = 0;
  for (int triangle = 0; triangle < talus::n_triangles(trn); ++triangle) {
    bool all = true;
    const auto corner = talus::triangle_corners(trn, triangle);
    for (const Vec3& point : corner) all = all && !std::isnan(point.z());
    EXPECT_EQ(talus::is_known(trn, triangle), all);
    const Vec3 middle = (corner[0] + corner[1] + corner[2]) / 3;
    EXPECT_EQ(std::isnan(talus::elevation_at(trn, middle.x(), middle.y())), !all);
    n_known += all;
  }
  EXPECT_GT(n_known, 20);
}

TEST(Trn, EdgesNameTheirNodesAndTheTwoTrianglesBesideThem) {
  const Trn trn = talus_test::planar_trn(5, 6, 1, 0, 0);
  for (int r = 1; r < 4; ++r)
    for (int c = 1; c < 5; ++c)
      for (const auto kind :
           {talus::EdgeKind::east, talus::EdgeKind::south, talus::EdgeKind::diagonal}) {
        const talus::TrnEdge edge = talus::trn_edge(trn, r, c, kind);
        const Vec3 a = talus::node_point(trn, edge.a.row, edge.a.col);
        const Vec3 along = talus::node_point(trn, edge.b.row, edge.b.col) - a;
        const Vec3 middle = a + along / 2;
        const Vec3 left = 1e-3 * Vec3(-along.y(), along.x(), 0);
        EXPECT_EQ(talus::triangle_at(trn, middle.x() + left.x(), middle.y() + left.y()), edge.left);
        EXPECT_EQ(talus::triangle_at(trn, middle.x() - left.x(), middle.y() - left.y()),
                  edge.right);
      }
}

TEST(Trn, UnusableGridsAreRefused) {
  EXPECT_NO_THROW(talus::check_trn(grid(2, 2), "a.tif"));
  Trn trn = grid(1, 9);
  EXPECT_THROW(talus::check_trn(trn, "a.tif"), talus::InputError);
  trn = grid(3, 3);
  trn.cell_size = nan;
  EXPECT_THROW(talus::check_trn(trn, "a.tif"), talus::InputError);
  trn = grid(3, 3);
  trn.elevation.pop_back();
  EXPECT_THROW(talus::check_trn(trn, "a.tif"), talus::InputError);
  trn = grid(3, 3);
  trn.elevation = {nan, 0, nan, 0, nan, 0, nan, 0, nan};  // known nodes, but no known triangle
  EXPECT_THROW(talus::check_trn(trn, "a.tif"), talus::InputError);
}

}  // namespace
