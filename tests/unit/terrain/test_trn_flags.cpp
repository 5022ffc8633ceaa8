// Convex features of the ground, against their definition.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <set>

#include "random_trn.hpp"
#include "terrain/trn_flags.hpp"

namespace {

using talus::EdgeKind;
using talus::Trn;
using talus::Vec2;
using talus::Vec3;

// Slope break across an edge from the normals of its two triangles: the change of gradient, > 0
// when the ground falls away on both sides.
double slope_break(const Trn& trn, const talus::TrnEdge& edge) {
  const talus::TrianglePlane left = talus::triangle_plane(trn, edge.left);
  const talus::TrianglePlane right = talus::triangle_plane(trn, edge.right);
  const auto gradient = [](const Vec3& n) { return Vec2(-n.x() / n.z(), -n.y() / n.z()); };
  const Vec3 along = talus::node_point(trn, edge.b.row, edge.b.col) -
                     talus::node_point(trn, edge.a.row, edge.a.col);
  const bool convex = left.normal.cross(right.normal).dot(along) > 0;
  return (convex ? 1 : -1) * (gradient(left.normal) - gradient(right.normal)).norm();
}

// Largest margin by which a plane through the node can stay above its six neighbours, as a slope:
// the best vertex of the linear programme max m: z_k - z_0 - g d_k + m |d_k| <= 0, found by trying
// every three of its six constraints.
double vertex_margin(const Trn& trn, int r, int c) {
  const int dr[6] = {0, 0, -1, 1, 1, -1}, dc[6] = {1, -1, 0, 0, 1, -1};
  const Vec3 node = talus::node_point(trn, r, c);
  Eigen::Matrix<double, 6, 3> A;
  Eigen::Matrix<double, 6, 1> b;
  for (int k = 0; k < 6; ++k) {
    const Vec3 arm = talus::node_point(trn, r + dr[k], c + dc[k]) - node;
    A.row(k) << -arm.x(), -arm.y(), arm.head<2>().norm();
    b(k) = -arm.z();
  }
  double best = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < 6; ++i)
    for (int j = i + 1; j < 6; ++j)
      for (int k = j + 1; k < 6; ++k) {
        Eigen::Matrix3d corner;
        corner << A.row(i), A.row(j), A.row(k);
        if (std::abs(corner.determinant()) < 1e-9) continue;
        const Vec3 x = corner.inverse() * Vec3(b(i), b(j), b(k));
        if (((A * x - b).array() <= 1e-9).all()) best = std::max(best, x.z());
      }
  return best;
}

bool flagged(const Trn& trn, const std::vector<std::uint8_t>& flags, int r, int c, int bit) {
  return (flags[talus::node_index(trn, r, c)] & bit) != 0;
}

TEST(GroundFlags, EdgesAgreeWithTheNormalsOfTheirTriangles) {
  talus::Random random(1, "edges");
  for (const double relief : {0.005, 0.5, 20.0}) {
    const Trn trn = talus_test::random_trn(random, 30, 25, relief);
    const auto flags = talus::ground_flags(trn);
    int n_convex = 0;
    const auto compare = [&](int r, int c, EdgeKind kind, int bit) {
      const double slope = slope_break(trn, talus::trn_edge(trn, r, c, kind));
      if (std::abs(slope - talus::default_convex_slope) < 1e-10) return;  // too close to call
      EXPECT_EQ(flagged(trn, flags, r, c, bit), slope > talus::default_convex_slope);
      n_convex += flagged(trn, flags, r, c, bit);
    };
    for (int r = 0; r < trn.n_rows - 1; ++r)
      for (int c = 0; c < trn.n_cols - 1; ++c) {
        if (r > 0) compare(r, c, EdgeKind::east, talus::trn_flag::convex_east);
        if (c > 0) compare(r, c, EdgeKind::south, talus::trn_flag::convex_south);
        compare(r, c, EdgeKind::diagonal, talus::trn_flag::convex_diagonal);
      }
    EXPECT_GT(n_convex, 500);
    EXPECT_LT(n_convex, 1600);
  }
}

TEST(GroundFlags, VerticesAgreeWithTheBestSupportingPlane) {
  talus::Random random(2, "vertices");
  for (const double relief : {0.005, 0.5, 20.0}) {
    const Trn trn = talus_test::random_trn(random, 22, 24, relief);
    const auto flags = talus::ground_flags(trn);
    int n_convex = 0;
    for (int r = 1; r < trn.n_rows - 1; ++r)
      for (int c = 1; c < trn.n_cols - 1; ++c) {
        const double margin = vertex_margin(trn, r, c);
        if (std::abs(margin - talus::default_convex_slope) < 1e-10) continue;
        EXPECT_EQ(flagged(trn, flags, r, c, talus::trn_flag::convex_vertex),
                  margin > talus::default_convex_slope);
        n_convex += margin > talus::default_convex_slope;
      }
    EXPECT_GT(n_convex, 50);
  }
}

// An unflagged edge opens by less than the stated angle, however steep the ground.
TEST(GroundFlags, UnflaggedEdgesOpenByLessThanTheStatedAngle) {
  talus::Random random(3, "angles");
  const double limit = 0.05;
  for (const double slope : {0.0, 1.0, 4.0}) {
    Trn trn = talus_test::planar_trn(30, 30, 2.5, slope, 0.5 * slope);
    for (double& z : trn.elevation) z += random.uniform(0, 0.3);
    const auto flags = talus::ground_flags(trn, limit);
    int n_unflagged = 0;
    for (int r = 0; r < 29; ++r)
      for (int c = 0; c < 29; ++c) {
        if (flagged(trn, flags, r, c, talus::trn_flag::convex_diagonal)) continue;
        const talus::TrnEdge edge = talus::trn_edge(trn, r, c, EdgeKind::diagonal);
        if (slope_break(trn, edge) < 0) continue;
        const Vec3 a = talus::triangle_plane(trn, edge.left).normal;
        const Vec3 b = talus::triangle_plane(trn, edge.right).normal;
        EXPECT_LE(std::atan2(a.cross(b).norm(), a.dot(b)), limit * (1 + 1e-12));
        ++n_unflagged;
      }
    EXPECT_GT(n_unflagged, 20);
  }
}

TEST(GroundFlags, APlaneHasNoFlagWhateverItsSlopeAndHeight) {
  for (const double slope : {0.0, 0.577, 3.0}) {
    const Trn trn = talus_test::planar_trn(40, 50, 4.99768, slope, -0.3 * slope);
    for (const std::uint8_t flag : talus::ground_flags(trn)) EXPECT_EQ(flag, 0);
  }
}

// A roof along a row of nodes: its ridge edges and nothing else, as a straight ridge has no corner.
TEST(GroundFlags, ARidgeHasConvexEdgesAndNoConvexVertex) {
  Trn trn = talus_test::planar_trn(9, 9, 1, 0, 0);
  for (int r = 0; r < 9; ++r)
    for (int c = 0; c < 9; ++c) trn.elevation[talus::node_index(trn, r, c)] = -std::abs(r - 4);
  const auto flags = talus::ground_flags(trn);
  for (int r = 0; r < 9; ++r)
    for (int c = 0; c < 9; ++c)
      EXPECT_EQ(flags[talus::node_index(trn, r, c)],
                r == 4 && c < 8 ? talus::trn_flag::convex_east : 0)
          << r << ' ' << c;
}

TEST(GroundFlags, APeakIsAConvexVertexAndAPitIsNot) {
  Trn trn = talus_test::planar_trn(5, 5, 2, 0.2, 0.1);
  trn.elevation[talus::node_index(trn, 2, 2)] += 1;
  auto flags = talus::ground_flags(trn);
  EXPECT_EQ(flags[talus::node_index(trn, 2, 2)], 15);
  trn.elevation[talus::node_index(trn, 2, 2)] -= 2;
  flags = talus::ground_flags(trn);
  EXPECT_EQ(flags[talus::node_index(trn, 2, 2)], 0);
}

// Beyond the rim of known ground is nothing that an edge could be convex against.
TEST(GroundFlags, TheRimOfKnownGroundHasNoFlags) {
  talus::Random random(4, "rim");
  const Trn trn = talus_test::random_trn(random, 25, 25, 10, 0.25);
  const auto flags = talus::ground_flags(trn);
  int n_flagged = 0;
  for (int r = 0; r < 24; ++r)
    for (int c = 0; c < 24; ++c)
      for (const auto& [kind, bit] :
           {std::pair(EdgeKind::east, talus::trn_flag::convex_east),
            std::pair(EdgeKind::south, talus::trn_flag::convex_south),
            std::pair(EdgeKind::diagonal, talus::trn_flag::convex_diagonal)}) {
        if (!flagged(trn, flags, r, c, bit)) continue;
        const talus::TrnEdge edge = talus::trn_edge(trn, r, c, kind);
        EXPECT_TRUE(talus::is_known(trn, edge.left) && talus::is_known(trn, edge.right));
        ++n_flagged;
      }
  EXPECT_GT(n_flagged, 50);
}

}  // namespace
