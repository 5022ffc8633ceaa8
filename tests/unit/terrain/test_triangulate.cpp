// Constrained triangulations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.hpp"
#include "base/random.hpp"
#include "geometry/segment_meetings.hpp"
#include "terrain/triangulate.hpp"

namespace {

using talus::Random;
using talus::TriangleMesh;
using talus::Triangulation;
using talus::Vec2;
using talus::Vec3;
using Segments = std::vector<std::array<int, 2>>;

const Vec3& at(const TriangleMesh& mesh, int i) { return mesh.points[static_cast<std::size_t>(i)]; }

double plan_area(const TriangleMesh& mesh, const std::array<int, 3>& corners) {
  const Vec3 u = at(mesh, corners[1]) - at(mesh, corners[0]);
  const Vec3 v = at(mesh, corners[2]) - at(mesh, corners[0]);
  return (u.x() * v.y() - u.y() * v.x()) / 2;
}

std::vector<Vec3> random_points(Random& random, int n) {
  std::vector<Vec3> points = {{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}};
  for (int i = 4; i < n; ++i)
    points.emplace_back(random.uniform(0.1, 99.9), random.uniform(0.1, 99.9), random.uniform());
  return points;
}

// Random segments that cross no earlier one.
Segments random_segments(Random& random, const std::vector<Vec3>& points) {
  std::vector<Vec2> places;
  for (const Vec3& p : points) places.push_back(p.head<2>());
  Segments segments;
  for (int i = 0; i < 60; ++i) {
    Segments tried = segments;
    const int a = static_cast<int>(random.below(points.size()));
    const int b = static_cast<int>(random.below(points.size()));
    if (a != b) tried.push_back({a, b});
    const auto meetings = talus::find_segment_meetings(places, tried);
    if (meetings.crossings.empty() && meetings.touches.empty()) segments = tried;
  }
  return segments;
}

TEST(Triangulation, TilesTheHullCounterClockwiseAndKeepsEverySegment) {
  Random random(3, "triangulation");
  for (int scene = 0; scene < 20; ++scene) {
    const std::vector<Vec3> points = random_points(random, 80);
    const Segments segments = random_segments(random, points);
    const TriangleMesh mesh = Triangulation(points, segments, "").mesh();
    ASSERT_EQ(mesh.points.size(), points.size());
    double area = 0;
    std::set<std::array<int, 2>> edges;
    for (const auto& corners : mesh.triangles) {
      ASSERT_GT(plan_area(mesh, corners), 0);
      area += plan_area(mesh, corners);
      for (std::size_t k = 0; k < 3; ++k)
        edges.insert({std::min(corners[k], corners[(k + 1) % 3]),
                      std::max(corners[k], corners[(k + 1) % 3])});
    }
    EXPECT_NEAR(area, 1e4, 1e-8);
    for (const auto& [a, b] : segments)
      EXPECT_TRUE(edges.count({std::min(a, b), std::max(a, b)}) == 1) << a << " " << b;
  }
}

TEST(Triangulation, NeighboursPointAtEachOtherAndShareTheEdge) {
  Random random(4, "neighbours");
  const std::vector<Vec3> points = random_points(random, 200);
  const TriangleMesh mesh = Triangulation(points, random_segments(random, points), "").mesh();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const int other = mesh.neighbors[t][k];
      if (other < 0) continue;
      const auto& back = mesh.neighbors[static_cast<std::size_t>(other)];
      const auto k_other = static_cast<std::size_t>(
          std::find(back.begin(), back.end(), static_cast<int>(t)) - back.begin());
      ASSERT_LT(k_other, 3U);
      const auto& corners = mesh.triangles[static_cast<std::size_t>(other)];
      EXPECT_EQ(mesh.triangles[t][(k + 1) % 3], corners[(k_other + 2) % 3]);
      EXPECT_EQ(mesh.constrained[t] >> k & 1,
                mesh.constrained[static_cast<std::size_t>(other)] >> k_other & 1);
    }
}

// Without segments: no point inside any triangle's circumcircle.
TEST(Triangulation, IsDelaunay) {
  Random random(5, "delaunay");
  const TriangleMesh mesh = Triangulation(random_points(random, 150), {}, "").mesh();
  for (const auto& corners : mesh.triangles) {
    const Vec2 a = at(mesh, corners[0]).head<2>(), b = at(mesh, corners[1]).head<2>();
    const Vec2 c = at(mesh, corners[2]).head<2>();
    const Vec2 u = b - a, v = c - a;
    const double twice = 2 * (u.x() * v.y() - u.y() * v.x());
    const Vec2 centre = a + Vec2(v.y() * u.squaredNorm() - u.y() * v.squaredNorm(),
                                 u.x() * v.squaredNorm() - v.x() * u.squaredNorm()) /
                                twice;
    for (const Vec3& p : mesh.points)
      EXPECT_GE((p.head<2>() - centre).norm(), (a - centre).norm() * (1 - 1e-9));
  }
}

TEST(Triangulation, AddedPointsStandBehindTheOthersAndATwinIsLeftOut) {
  Triangulation triangulation({{0, 0, 1}, {10, 0, 2}, {0, 10, 3}}, {{{0, 1}}}, "");
  triangulation.add({{2, 2, 9}, {0, 0, 7}});
  const TriangleMesh mesh = triangulation.mesh();
  ASSERT_EQ(mesh.points.size(), 4U);
  EXPECT_EQ(mesh.points[3], Vec3(2, 2, 9));
  EXPECT_EQ(mesh.points[0].z(), 1);
  EXPECT_EQ(mesh.triangles.size(), 3U);
}

TEST(Triangulation, RefusesPointsOnOneLineAndSegmentsThatCross) {
  EXPECT_THROW(Triangulation({{0, 0, 0}, {1, 1, 0}, {3, 3, 0}}, {{{0, 1}}}, "map"),
               talus::InputError);
  EXPECT_THROW(
      Triangulation({{0, 0, 0}, {2, 2, 0}, {0, 2, 1}, {2, 0, 1}}, {{{0, 1}}, {{2, 3}}}, "map"),
      talus::InputError);
}

}  // namespace
