// Scattered points as triangles: spikes, pits, doubles.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "base/error.hpp"
#include "terrain/point_tin.hpp"

namespace {

using namespace talus;

// Points of a plane that rises 1 : 2 to the north, about 10 m apart.
std::vector<Vec3> slope() {
  std::vector<Vec3> points;
  for (int r = 0; r < 11; ++r)
    for (int c = 0; c < 11; ++c) {
      const double x = 10 * c + (7 * r + 3 * c) % 5, y = 10 * r + (3 * r + 5 * c) % 4;
      points.emplace_back(x, y, 1000 + 0.5 * y);
    }
  return points;
}

TEST(PointTin, APlaneIsMetByEveryTriangle) {
  const PointMesh found = mesh_of_points(slope(), "p");
  EXPECT_EQ(found.n_read, 121U);
  EXPECT_EQ(found.n_repeated, 0U);
  EXPECT_TRUE(found.doubts.empty());
  double area = 0;
  for (const auto& [a, b, c] : found.mesh.triangles) {
    const Vec3 &p = found.mesh.points[a], u = found.mesh.points[b] - p,
               v = found.mesh.points[c] - p;
    area += (u.x() * v.y() - u.y() * v.x()) / 2;
    const Vec3 middle = p + (u + v) / 3;
    EXPECT_NEAR(middle.z(), 1000 + 0.5 * middle.y(), 1e-9);
  }
  EXPECT_GT(area, 10000);
}

TEST(PointTin, SpikesAndPitsAreInDoubtAndKilometresImpossible) {
  for (const auto& [height, is_doubt, is_impossible] : {std::tuple{1030.0, false, false},
                                                        {1090.0, true, false},
                                                        {0.0, true, true},
                                                        {-9.0, true, true},
                                                        {9999.0, true, true}}) {
    std::vector<Vec3> points = slope();
    points[60].z() = height;  // 1025 at its place
    const PointMesh found = mesh_of_points(points, "p");
    ASSERT_EQ(found.doubts.size(), is_doubt ? 1U : 0U) << height;
    if (!is_doubt) continue;
    EXPECT_EQ(found.doubts[0].place.z(), height);
    EXPECT_EQ(found.doubts[0].is_impossible, is_impossible) << height;
    EXPECT_NEAR(found.doubts[0].low, 1018, 4);
  }
}

TEST(PointTin, PointsInOnePlaceAreOneUnlessTheirHeightsDiffer) {
  std::vector<Vec3> points = slope();
  points.push_back(points[5]);
  PointMesh found = mesh_of_points(points, "p");
  EXPECT_EQ(found.n_repeated, 1U);
  EXPECT_TRUE(found.doubts.empty());
  points.back().z() += 0.04;  // two returns of a laser at places rounded to centimetres
  found = mesh_of_points(points, "p");
  EXPECT_EQ(found.n_repeated, 1U);
  EXPECT_NEAR(found.repeated_differ_m, 0.04, 1e-12);
  EXPECT_TRUE(found.doubts.empty());
  points.back().z() += 3;
  found = mesh_of_points(points, "p");
  ASSERT_EQ(found.doubts.size(), 1U);
  EXPECT_TRUE(found.doubts[0].is_impossible);
  EXPECT_NEAR(found.doubts[0].place.z() - found.doubts[0].low, 3.04, 1e-12);
}

TEST(PointTin, OfTwoPointsSideBySideTheUpperOneIsInDoubt) {
  for (const double gap : {0.05, 0.3}) {
    std::vector<Vec3> points = slope();
    points.emplace_back(points[60] + Vec3(0, gap, -3));
    const PointMesh found = mesh_of_points(points, "p");
    ASSERT_EQ(found.doubts.size(), 1U) << gap;
    EXPECT_EQ(found.doubts[0].place, points[60]);
    EXPECT_EQ(found.doubts[0].low, points[60].z() - 3);
    EXPECT_FALSE(found.doubts[0].is_impossible);
    points.back().z() += 2.6;
    EXPECT_TRUE(mesh_of_points(points, "p").doubts.empty());
  }
  // a rock face as a scan sees it, 0.3 m apart on it
  std::vector<Vec3> face;
  for (int r = 0; r < 30; ++r)
    for (int c = 0; c < 30; ++c)
      face.emplace_back(0.3 * c, 0.1 * r, 10 * std::max(0, r - 10) * 0.1);
  EXPECT_TRUE(mesh_of_points(face, "p").doubts.empty());
}

TEST(PointTin, GapsShowInTheLongestEdge) {
  std::vector<Vec3> points = slope();
  const EdgeLengths even = edge_lengths(mesh_of_points(points, "p").mesh);
  EXPECT_LT(even.longest, 5 * even.median);
  points.emplace_back(400, 50, 1025);
  EXPECT_GT(edge_lengths(mesh_of_points(points, "p").mesh).longest, 290);
}

TEST(PointTin, PointsOnOneLineAreRefused) {
  EXPECT_THROW(static_cast<void>(mesh_of_points({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, "p")),
               InputError);
}

}  // namespace
