// Lattices over triangle meshes, and spread values.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "base/random.hpp"
#include "geometry/orient2d.hpp"
#include "terrain/lattice.hpp"

namespace {

using talus::Lattice;
using talus::TriangleMesh;
using talus::Vec2;
using talus::Vec3;

TriangleMesh random_mesh(std::uint64_t seed) {
  talus::Random random(seed, "lattice");
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i)
    points.emplace_back(std::floor(random.uniform(0, 40)), random.uniform(0, 40), random.uniform());
  return talus::Triangulation(points, {}, "").mesh();
}

bool covers(const TriangleMesh& mesh, const std::array<int, 3>& corners, const Vec2& place) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = mesh.points[static_cast<std::size_t>(corners[k])].head<2>();
    const Vec2 b = mesh.points[static_cast<std::size_t>(corners[(k + 1) % 3])].head<2>();
    if (talus::orient2d(a, b, place) < 0) return false;
  }
  return true;
}

TEST(Lattice, EveryNodeKnowsItsTriangle) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TriangleMesh mesh = random_mesh(seed);
    const Lattice lattice = talus::lay_lattice(mesh, 0.7);
    int n_inside = 0;
    for (std::size_t node = 0; node < lattice.size(); ++node) {
      const Vec2 place = lattice.place(node);
      const bool expected = std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                                        [&](const auto& c) { return covers(mesh, c, place); });
      ASSERT_EQ(lattice.triangle[node] >= 0, expected) << place.transpose();
      if (!expected) continue;
      ++n_inside;
      EXPECT_TRUE(
          covers(mesh, mesh.triangles[static_cast<std::size_t>(lattice.triangle[node])], place));
    }
    EXPECT_GT(n_inside, 1000);
  }
}

TEST(Lattice, HeightInATriangleIsThatOfItsPlane) {
  TriangleMesh mesh;
  mesh.points = {{1, 1, 0}, {7, 2, 0}, {3, 9, 0}};
  for (Vec3& p : mesh.points) p.z() = 5 + 2 * p.x() - 0.5 * p.y();
  mesh.triangles = {{0, 1, 2}};
  EXPECT_NEAR(talus::height_in_triangle(mesh, 0, {4, 4}), 5 + 8 - 2, 1e-12);
}

TEST(Lattice, DividesLongLinesOnceForBothSides) {
  const TriangleMesh mesh =
      talus::Triangulation({{0, 0, 0}, {10, 0, 5}, {5, 8, 0}, {5, -8, 0}}, {{{0, 1}}}, "").mesh();
  const std::vector<Vec3> between = talus::points_between(mesh, 3);
  ASSERT_EQ(between.size(), 3U);  // four parts of 2.5 m
  for (const Vec3& p : between) EXPECT_NEAR(p.z(), p.x() / 2, 1e-12);
}

TEST(Lattice, DistanceIsTheEuclideanOneWithinEightPercent) {
  const TriangleMesh mesh = random_mesh(11);
  const Lattice lattice = talus::lay_lattice(mesh, 0.5);
  const std::vector<Vec3> points = {{10.2, 11.7, 0}, {30.1, 25.3, 0}}, more = {{5.5, 35.2, 0}};
  const std::vector<float> distance = talus::distance_to_points(lattice, points, more);
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    double nearest = (lattice.place(node) - more[0].head<2>()).norm();
    for (const Vec3& p : points)
      nearest = std::min(nearest, (lattice.place(node) - p.head<2>()).norm());
    EXPECT_GE(distance[node], nearest - 1e-4);
    EXPECT_LE(distance[node], 1.0824 * nearest + 0.1 * lattice.spacing);
  }
}

TEST(SpreadValues, KeepsWhatIsKnownAndStaysBetweenItsExtremes) {
  const int n_x = 37, n_y = 23;
  std::vector<float> values(n_x * n_y, 0);
  std::vector<std::uint8_t> known(values.size(), 0);
  talus::Random random(6, "spread");
  for (std::size_t i = 0; i < values.size(); i += 17) {
    values[i] = static_cast<float>(random.uniform(2, 3));
    known[i] = 1;
  }
  const std::vector<float> before = values;
  talus::spread_values(n_x, n_y, values, known);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (known[i] != 0) {
      EXPECT_EQ(values[i], before[i]);
    }
    EXPECT_GE(values[i], 2);
    EXPECT_LE(values[i], 3);
  }
}

TEST(SpreadValues, NothingKnownGivesZero) {
  std::vector<float> values(12, 5);
  talus::spread_values(4, 3, values, std::vector<std::uint8_t>(12, 0));
  for (const float value : values) EXPECT_EQ(value, 0);
}

}  // namespace
