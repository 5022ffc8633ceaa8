// Flat triangles and the heights that mend them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "base/random.hpp"
#include "terrain/contours.hpp"
#include "terrain/flat.hpp"

namespace {

using talus::CleanLines;
using talus::ContourMap;
using talus::MeasuredPoints;
using talus::MendingPoints;
using talus::TriangleMesh;
using talus::Triangulation;
using talus::Vec2;
using talus::Vec3;

// A closed contour around the centre, of radius(angle).
void add_ring(ContourMap& map, double height, const std::function<double(double)>& radius, int n) {
  for (int i = 0; i <= n; ++i) {
    const double angle = 2 * std::numbers::pi * (i % n) / n;
    map.contours.points.emplace_back(radius(angle) * std::cos(angle),
                                     radius(angle) * std::sin(angle), height);
  }
  map.contours.begin.push_back(static_cast<int>(map.contours.points.size()));
  map.contours.feature.push_back(0);
}

struct Scene {
  TriangleMesh mesh;
  MeasuredPoints measured;
  double interval = 0;
};

Scene triangulate(const ContourMap& map) {
  CleanLines clean = talus::clean_lines(map);
  const MeasuredPoints measured{clean.n_contour_points, static_cast<int>(clean.points.size())};
  return {Triangulation(clean.points, clean.segments, "").mesh(), measured,
          talus::contour_interval(map)};
}

MendingPoints mend(const Scene& scene) {
  TriangleMesh mesh = scene.mesh;
  return talus::mend_flat_triangles(mesh, talus::find_flat_triangles(scene.mesh, scene.measured),
                                    {scene.interval, 0});
}

// A cone of slope 1/2 with contours every 10 m, its top at 55 m, five metres above the last
// contour.
ContourMap cone() {
  ContourMap map;
  for (int i = 0; i <= 5; ++i)
    add_ring(
        map, 10 * i, [i](double) { return 110.0 - 20 * i; }, 60);
  return map;
}

TEST(FlatTriangles, AreTheSummitOfACone) {
  const Scene scene = triangulate(cone());
  const auto flat = talus::find_flat_triangles(scene.mesh, scene.measured);
  const double area = talus::area_of(scene.mesh, flat).marked_m2;
  const double polygon = 0.5 * 60 * 10 * 10 * std::sin(2 * std::numbers::pi / 60);  // inside 50 m
  EXPECT_NEAR(area, polygon, 1e-9);
}

// A spot height on the top, and a lake shore given as a breakline, are known ground: not flat.
TEST(FlatTriangles, AreNotThoseOfMeasuredPoints) {
  ContourMap map = cone();
  map.spots = {{0, 0, 55}};
  const Scene with_spot = triangulate(map);
  const auto flat = talus::find_flat_triangles(with_spot.mesh, with_spot.measured);
  EXPECT_EQ(talus::area_of(with_spot.mesh, flat).marked_m2, 0);

  ContourMap lake = cone();
  for (const Vec2& p : {Vec2(4, 0), Vec2(0, 4), Vec2(-4, 0), Vec2(0, -4), Vec2(4, 0)})
    lake.breaklines.points.emplace_back(p.x(), p.y(), 50);
  lake.breaklines.begin.push_back(5);
  lake.breaklines.feature.push_back(0);
  const Scene with_lake = triangulate(lake);
  for (const Vec3& p : mend(with_lake).points) EXPECT_GT(std::abs(p.x()) + std::abs(p.y()), 4);
}

TEST(Mending, RaisesTheSummitTowardsTheTrueTopAndNotPastTheNextContour) {
  const Scene scene = triangulate(cone());
  const MendingPoints mended = mend(scene);
  ASSERT_FALSE(mended.points.empty());
  double highest = 0;
  for (const Vec3& p : mended.points) {
    if (p.head<2>().norm() > 10) continue;
    EXPECT_GT(p.z(), 50);
    highest = std::max(highest, p.z());
  }
  EXPECT_GT(highest, 52);  // a cone's top is 5 m up; linear interpolation says 0
  EXPECT_LT(highest, 55);
}

TEST(Mending, APitIsASummitUpsideDown) {
  ContourMap pit = cone();
  for (Vec3& p : pit.contours.points) p.z() = 100 - p.z();
  const MendingPoints up = mend(triangulate(cone())), down = mend(triangulate(pit));
  ASSERT_EQ(up.points.size(), down.points.size());
  for (std::size_t i = 0; i < up.points.size(); ++i)
    EXPECT_NEAR(up.points[i].z(), 100 - down.points[i].z(), 1e-8);
}

// Ragged rings on random ground: no added point may leave the band that the contours allow it.
TEST(Mending, NeverPassesTheNextContour) {
  talus::Random random(8, "mending");
  for (int scene_number = 0; scene_number < 12; ++scene_number) {
    ContourMap map;
    const double phase = random.uniform(0, 6), amplitude = random.uniform(0.02, 0.15);
    const int lobes = 3 + static_cast<int>(random.below(9));
    const double steep = random.uniform(2, 25);
    for (int i = 0; i < 6; ++i) {
      const double mean = 200 - steep * i;
      add_ring(
          map, 10 * i,
          [&](double angle) { return mean * (1 + amplitude * std::cos(lobes * angle + phase)); },
          180);
    }
    const Scene scene = triangulate(map);
    const auto flat = talus::find_flat_triangles(scene.mesh, scene.measured);
    const MendingPoints mended = mend(scene);
    ASSERT_FALSE(mended.points.empty());
    for (const Vec3& p : mended.points) {
      double low = 1e9, high = -1e9;  // of the triangle that holds the point
      for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vec3& a = scene.mesh.points[static_cast<std::size_t>(scene.mesh.triangles[t][k])];
          const Vec3& b =
              scene.mesh.points[static_cast<std::size_t>(scene.mesh.triangles[t][(k + 1) % 3])];
          inside &= (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x()) >= -1e-9;
        }
        if (!inside) continue;
        for (const int corner : scene.mesh.triangles[t]) {
          const double z = scene.mesh.points[static_cast<std::size_t>(corner)].z();
          low = std::min(low, flat[t] != 0 ? z - scene.interval / 2 : z);
          high = std::max(high, flat[t] != 0 ? z + scene.interval / 2 : z);
        }
      }
      EXPECT_GT(p.z(), low);
      EXPECT_LT(p.z(), high);
    }
  }
}

struct MendedScene {
  TriangleMesh before, after;
  std::vector<std::uint8_t> flat_before, flat_after;
};

MendedScene mend_ragged_rings() {
  ContourMap map;
  for (int i = 0; i < 6; ++i)
    add_ring(
        map, 10 * i,
        [i](double angle) { return (200.0 - 25 * i) * (1 + 0.15 * std::cos(6 * angle)); }, 180);
  CleanLines clean = talus::clean_lines(map);
  const MeasuredPoints measured{clean.n_contour_points, static_cast<int>(clean.points.size())};
  Triangulation triangulation(clean.points, clean.segments, "");
  MendedScene scene;
  scene.before = triangulation.mesh();
  scene.flat_before = talus::find_flat_triangles(scene.before, measured);
  scene.after = scene.before;
  const MendingPoints mended = talus::mend_flat_triangles(scene.after, scene.flat_before, {10, 0});
  triangulation.fix_edges(mended.border);
  triangulation.add(mended.points);
  triangulation.refresh(scene.after);
  scene.flat_after = talus::find_flat_triangles(scene.after, measured);
  return scene;
}

TEST(Mending, LeavesHardlyAnyFlatTriangle) {
  const MendedScene scene = mend_ragged_rings();
  const talus::AreaShare before = talus::area_of(scene.before, scene.flat_before);
  const talus::AreaShare after = talus::area_of(scene.after, scene.flat_after);
  EXPECT_GT(before.share(), 0.1);
  EXPECT_LT(after.share(), 0.1 * before.share());
  EXPECT_NEAR(before.all_m2, after.all_m2, 1e-6);
}

// Triangles away from flat ones are still there, corner by corner.
TEST(Mending, LeavesTheSlopesAsTheyAre) {
  const MendedScene scene = mend_ragged_rings();
  const auto sorted = [](std::array<int, 3> corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::set<std::array<int, 3>> after;
  for (const auto& corners : scene.after.triangles) after.insert(sorted(corners));
  int n_slopes = 0;
  for (std::size_t t = 0; t < scene.before.triangles.size(); ++t) {
    const auto is_flat = [&](int other) {
      return other >= 0 && scene.flat_before[static_cast<std::size_t>(other)] != 0;
    };
    const auto& neighbors = scene.before.neighbors[t];
    if (scene.flat_before[t] != 0 || std::any_of(neighbors.begin(), neighbors.end(), is_flat))
      continue;
    ++n_slopes;
    EXPECT_EQ(after.count(sorted(scene.before.triangles[t])), 1U);
  }
  EXPECT_GT(n_slopes, 500);
}

TEST(Mending, IsTheSameEveryTime) {
  const MendingPoints first = mend(triangulate(cone())), second = mend(triangulate(cone()));
  ASSERT_EQ(first.points.size(), second.points.size());
  for (std::size_t i = 0; i < first.points.size(); ++i)
    EXPECT_EQ(first.points[i], second.points[i]);
}

TEST(BendInto, RisesKeepsTheMiddleAndNeverReachesTheBounds) {
  double before = -1e9;
  for (double value = -30; value <= 30; value += 0.01) {
    const double bent = talus::bend_into(value, -5, 5);
    EXPECT_GE(bent, before);
    EXPECT_GE(bent, -5);
    EXPECT_LE(bent, 5);
    if (std::abs(value) < 3) {
      EXPECT_EQ(bent, value);
    }
    EXPECT_LT(std::abs(bent - before),
              before > -1e8 ? 0.0101 : 1e10);  // no jump, slope at most one
    before = bent;
  }
}

}  // namespace
