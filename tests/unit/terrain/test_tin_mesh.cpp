// TINs cut to boundaries.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "terrain/tin_mesh.hpp"

namespace {

using talus::ContourMap;
using talus::Tin;
using talus::TriangleMesh;
using talus::Vec2;
using talus::Vec3;

// 20 x 20 squares of 1 m, with heights x + y.
TriangleMesh raster_mesh() {
  std::vector<Vec3> points;
  for (int j = 0; j <= 20; ++j)
    for (int i = 0; i <= 20; ++i) points.emplace_back(i, j, i + j);
  return talus::Triangulation(points, {}, "").mesh();
}

double area_of(const Tin& tin) {
  double area = 0;
  for (const auto& [a, b, c] : tin.triangles) {
    const Vec3 u =
        tin.points[static_cast<std::size_t>(b)] - tin.points[static_cast<std::size_t>(a)];
    const Vec3 v =
        tin.points[static_cast<std::size_t>(c)] - tin.points[static_cast<std::size_t>(a)];
    area += (u.x() * v.y() - u.y() * v.x()) / 2;
  }
  return area;
}

TEST(Boundary, WithoutRingsNothingIsCut) {
  TriangleMesh mesh = raster_mesh();
  talus::cut_to_rings({}, mesh);
  EXPECT_EQ(mesh.triangles.size(), 800U);
}

TEST(Boundary, KeepsTheRingWithoutItsHole) {
  TriangleMesh mesh = raster_mesh();
  const std::vector<Vec2> outer = {{2, 2}, {12, 2}, {12, 8}, {2, 8}};
  const std::vector<Vec2> hole = {{5, 4}, {5, 6}, {9, 6}, {9, 4}};
  talus::cut_to_rings({{0, outer}, {0, hole}}, mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const int other : mesh.neighbors[t])
      EXPECT_LT(other, static_cast<int>(mesh.triangles.size()));
  ContourMap map;
  map.origin = Vec3(100, 200, 0);
  map.crs_wkt = "LOCAL_CS[]";
  const Tin tin = talus::to_tin(mesh, map);
  EXPECT_NEAR(area_of(tin), 60 - 8, 1e-12);
  EXPECT_EQ(tin.points.size(), 11U * 7 - 3);  // three points are inside the hole
  EXPECT_EQ(tin.origin, map.origin);
  EXPECT_EQ(tin.crs_wkt, map.crs_wkt);
  for (const Vec3& p : tin.points) EXPECT_EQ(p.z(), p.x() + p.y());
}

TEST(Boundary, OverlappingPolygonsAreUnited) {
  TriangleMesh mesh = raster_mesh();
  talus::cut_to_rings({{0, {{2, 2}, {10, 2}, {10, 8}, {2, 8}}},
                       {0, {{3, 3}, {3, 5}, {5, 5}, {5, 3}}},
                       {1, {{4, 4}, {12, 4}, {12, 10}, {4, 10}}}},
                      mesh);
  // two rectangles of 8 x 6 that share 6 x 4, and the part of the hole outside the second one
  EXPECT_NEAR(area_of(talus::to_tin(mesh, {})), 48 + 48 - 24 - 3, 1e-12);
}

TEST(Boundary, APolygonThatCrossesItselfIsRefusedWithThePlace) {
  ContourMap map;
  map.origin = Vec3(500000, 5200000, 0);
  map.boundary = {{0, {{0, 0}, {9, 0}, {9, 9}}}, {1, {{0, 0}, {10, 10}, {10, 0}, {0, 10}}}};
  try {
    talus::check_boundary(map, "b.gpkg");
    FAIL() << "accepted";
  } catch (const talus::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "b.gpkg: polygon 2 of the boundary crosses itself at x 500005, y 5200005");
  }
  map.boundary = {{0, {{0, 0}, {10, 0}, {10, 10}, {0, 10}}},  // a hole that touches its ring
                  {0, {{0, 5}, {5, 2}, {5, 8}}},
                  {1, {{5, 5}, {15, 5}, {15, 15}, {5, 15}}}};
  EXPECT_NO_THROW(talus::check_boundary(map, "b.gpkg"));
}

TEST(Boundary, ARingElsewhereLeavesNothing) {
  TriangleMesh mesh = raster_mesh();
  talus::cut_to_rings({{0, {{50, 50}, {60, 50}, {60, 60}}}}, mesh);
  EXPECT_TRUE(mesh.triangles.empty());
}

TEST(Boundary, ItsAreaCountsOverlapsOnceAndHolesNot) {
  const auto ring = [](int polygon, double low, double high) {
    return talus::BoundaryRing{
        polygon, {Vec2(low, low), Vec2(high, low), Vec2(high, high), Vec2(low, high)}};
  };
  EXPECT_EQ(talus::area_of(std::vector<talus::BoundaryRing>{}), 0);
  EXPECT_NEAR(talus::area_of({ring(0, 0, 20), ring(0, 5, 10)}), 375, 2);
  EXPECT_NEAR(talus::area_of({ring(0, 0, 20), ring(1, 5, 10)}), 400, 2);
}

}  // namespace
