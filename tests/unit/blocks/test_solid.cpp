// Areas for placement, shapes, and solid bodies from surfaces.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>

#include "base/error.hpp"
#include "blocks/part_faces.hpp"
#include "blocks/placement.hpp"
#include "blocks/shapes.hpp"
#include "blocks/solid.hpp"
#include "scenes.hpp"

namespace {

using namespace talus;
using namespace talus::test;

// Side walls up along a closed plan, with caps: a prism over any simple polygon.
Polyhedron extruded(const std::vector<Vec2>& plan, double height) {
  Polyhedron body;
  const int n = static_cast<int>(plan.size());
  for (const double z : {0.0, height})
    for (const Vec2& p : plan) body.vertices.emplace_back(p.x(), p.y(), z);
  std::vector<int> bottom, top;
  for (int k = 0; k < n; ++k) {
    bottom.push_back(n - 1 - k);
    top.push_back(n + k);
    add_face(body, std::array{k, (k + 1) % n, n + (k + 1) % n, n + k}, 0);
  }
  add_face(body, bottom, 0);
  add_face(body, top, 0);
  return body;
}

std::vector<Vec2> star(int n_points, double inner) {
  std::vector<Vec2> plan;
  for (int k = 0; k < 2 * n_points; ++k) {
    const double angle = std::numbers::pi * k / n_points;
    const double radius = k % 2 ? inner : 1;
    plan.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return plan;
}

std::string refusal(const Polyhedron& surface) {
  bool was_turned = false;
  try {
    static_cast<void>(make_solid(surface, {"m.obj"}, was_turned));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST(MakeSolid, ConvexBodiesStayWholeAndLoseTheirDiagonals) {
  Polyhedron cube = box({0, 0, 0}, {1, 1, 1});
  Polyhedron triangles;
  triangles.vertices = cube.vertices;
  for (int f = 0; f < 6; ++f) {
    const auto loop = face(cube, f);
    add_face(triangles, std::array{loop[0], loop[1], loop[2]}, 0);
    add_face(triangles, std::array{loop[0], loop[2], loop[3]}, 0);
  }
  bool was_turned = true;
  const Body body = make_solid(triangles, {}, was_turned);
  EXPECT_FALSE(was_turned);
  ASSERT_EQ(body.parts.size(), 1u);
  EXPECT_EQ(n_faces(body.parts[0]), 6);
  EXPECT_DOUBLE_EQ(moments(body.parts[0]).volume, 1);
}

TEST(MakeSolid, InsideOutBodiesAreTurned) {
  Polyhedron cube = box({0, 0, 0}, {1, 1, 1});
  for (int f = 0; f < 6; ++f)
    std::reverse(cube.face_vertices.begin() + 4 * f, cube.face_vertices.begin() + 4 * f + 4);
  bool was_turned = false;
  const Body body = make_solid(cube, {}, was_turned);
  EXPECT_TRUE(was_turned);
  EXPECT_DOUBLE_EQ(moments(body.parts[0]).volume, 1);
}

TEST(MakeSolid, NonConvexBodiesBecomeConvexPartsOfTheSameVolume) {
  Random random(4);
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 4 + trial % 5;
    Polyhedron body = extruded(star(n, random.uniform(0.2, 0.65)), random.uniform(0.5, 2));
    const Mat3 turn = random_rotation(random);
    for (Vec3& v : body.vertices) v = turn * v;
    bool was_turned = false;
    const Body solid = make_solid(body, {}, was_turned);
    EXPECT_GT(solid.parts.size(), 1u);
    EXPECT_LE(solid.parts.size(), static_cast<size_t>(2 * n));
    double sum = 0;
    for (const Polyhedron& part : solid.parts) {
      EXPECT_TRUE(is_convex(part, 1e-7));
      EXPECT_EQ(check_surface(part).fault, SurfaceFault::none);
      sum += moments(part).volume;
    }
    EXPECT_NEAR(sum, moments(body).volume, 1e-9 * sum);
    EXPECT_NEAR(moments(solid.shell).volume, sum, 1e-9 * sum);
  }
}

// Coordinates of files are rounded, so polygons are not quite flat. A convex body stays one, any
// other is taken apart into parts that fill it.
TEST(MakeSolid, TakesPolygonsThatAreNotQuiteFlat) {
  Random random(5);
  const auto turned_and_rounded = [&random](Polyhedron body, double step) {
    const Mat3 turn = random_rotation(random);
    for (Vec3& v : body.vertices) v = step * ((turn * v) / step).array().round().matrix();
    return body;
  };
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const double step = std::pow(10, -2 - trial % 5);
    bool was_turned = false;
    for (const Polyhedron& body : {box({0, 0, 0}, {2, 2, 2}), prism(7, 2, 3)}) {
      const Body whole = make_solid(turned_and_rounded(body, step), {}, was_turned);
      ASSERT_EQ(whole.parts.size(), 1u);
      EXPECT_EQ(check_surface(whole.parts[0]).fault, SurfaceFault::none);
      EXPECT_TRUE(is_convex(whole.parts[0], 1e-6));
      EXPECT_NEAR(moments(whole.parts[0]).volume, moments(body).volume, 20 * step);
    }
    const Body angle = make_solid(
        turned_and_rounded(extruded({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 1), step), {},
        was_turned);
    double sum = 0;
    for (const Polyhedron& part : angle.parts) sum += moments(part).volume;
    EXPECT_NEAR(sum, moments(angle.shell).volume, 1e-6 * sum);
    EXPECT_NEAR(sum, 3, 20 * step);
    EXPECT_GT(angle.parts.size(), 1u);
  }
}

TEST(MakeSolid, RefusesWhatIsNoSolidAndSaysWhere) {
  Polyhedron open = box({0, 0, 0}, {1, 1, 1});
  open.face_begin.pop_back(), open.face_tag.pop_back(), open.face_vertices.resize(20);
  EXPECT_NE(refusal(open).find("open"), std::string::npos);
  EXPECT_NE(refusal(open).find("at the edge ("), std::string::npos);

  Polyhedron flat = box({0, 0, 0}, {1, 1, 1});
  for (Vec3& v : flat.vertices) v.z() = 0;
  EXPECT_NE(refusal(flat).find("flat"), std::string::npos);

  // a bow tie: its walls cross in the middle
  EXPECT_NE(refusal(extruded({{0, 0}, {3, 1}, {3, 0}, {0, 1.5}}, 1)).find("cuts through itself"),
            std::string::npos);
  // a spike that leaves through the opposite side
  Polyhedron spiked = box({0, 0, 0}, {1, 1, 1});
  spiked.face_begin.pop_back(), spiked.face_tag.pop_back(), spiked.face_vertices.resize(20);
  spiked.vertices.emplace_back(0.5, 0.5, -1);
  for (const auto& side : {std::array{4, 5, 8}, {5, 7, 8}, {7, 6, 8}, {6, 4, 8}})
    add_face(spiked, side, 0);
  EXPECT_NE(refusal(spiked).find("cuts through itself"), std::string::npos);
  Polyhedron strange = box({0, 0, 0}, {1, 1, 1});
  strange.vertices[0].x() = std::nan("");
  EXPECT_NE(refusal(strange).find("not finite"), std::string::npos);
}

// Parts stay the parts that they are; faces between them are internal, also where a part lies on a
// larger face.
TEST(MakeSolid, GivenPartsAreKept) {
  Polyhedron turned = box({0, 0, 1}, {1, 1, 2});
  for (int f = 0; f < 6; ++f)
    std::reverse(turned.face_vertices.begin() + 4 * f, turned.face_vertices.begin() + 4 * f + 4);
  bool was_turned = false;
  const Body body =
      make_solid_of_parts({box({0, 0, 0}, {2, 1, 1}), turned}, {"m.obj", 0, "r"}, was_turned);
  EXPECT_TRUE(was_turned);
  ASSERT_EQ(body.parts.size(), 2u);
  EXPECT_EQ(n_faces(body.shell), 0);
  EXPECT_DOUBLE_EQ(moments(body.parts[0]).volume, 2);
  EXPECT_DOUBLE_EQ(moments(body.parts[1]).volume, 1);
  const auto n_internal = [](const Polyhedron& part) {
    return std::count(part.face_tag.begin(), part.face_tag.end(), int{face_internal});
  };
  EXPECT_EQ(n_internal(body.parts[0]), 0);  // half of its top is bare
  EXPECT_EQ(n_internal(body.parts[1]), 1);
  EXPECT_TRUE(hang_together(body.parts));
}

TEST(MakeSolid, PartsThatAreNoneAreRefused) {
  const auto refused = [](const std::vector<Polyhedron>& parts) -> std::string {
    bool was_turned = false;
    try {
      static_cast<void>(make_solid_of_parts(parts, {"m.obj", 0, "r"}, was_turned));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const Polyhedron cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(refused({cube, extruded(star(4, 0.4), 1)}),
            "m.obj: r, part 1: a part is not one convex body");
  Polyhedron two = cube;
  const Polyhedron other = box({3, 0, 0}, {4, 1, 1});
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (int f = 0; f < 6; ++f) {
    std::vector<int> loop;
    for (const int v : face(other, f)) loop.push_back(v + 8);
    add_face(two, loop, 0);
  }
  EXPECT_EQ(refused({two}), "m.obj: r, part 0: a part is not one convex body");
  Polyhedron open = cube;
  open.face_begin.pop_back(), open.face_tag.pop_back(), open.face_vertices.resize(20);
  EXPECT_NE(refused({cube, open}).find("r, part 1: the mesh is open"), std::string::npos);
  EXPECT_EQ(refused({cube, box({0.5, 0, 0}, {1.5, 1, 1})}),
            "m.obj: r: the parts of the body overlap by 0.5 m3 of 2 m3, which would count twice");
  EXPECT_EQ(refused({cube, cube}),
            "m.obj: r: the parts of the body overlap by 1 m3 of 2 m3, which would count twice");
  EXPECT_EQ(refused({cube, box({1 - 1e-9, 0, 0}, {2, 1, 1})}), "accepted");  // rounding
}

// Over faces, not over an edge or across a gap.
TEST(PartFaces, PartsHangTogetherOverFaces) {
  const Polyhedron cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(hang_together({cube}));
  EXPECT_TRUE(hang_together({cube, box({2, 0, 0}, {3, 1, 1}), box({1, 0.5, 0}, {2, 1, 1})}));
  EXPECT_FALSE(hang_together({cube, box({1, 1, 0}, {2, 2, 1})}));
  EXPECT_FALSE(hang_together({cube, box({1.01, 0, 0}, {2, 1, 1})}));
  EXPECT_DOUBLE_EQ(shared_volume({cube, box({0.5, 0.5, 0.5}, {2, 2, 2})}), 0.125);
}

TEST(Shapes, VolumesAreTheClosedForms) {
  for (int n = 3; n < 13; ++n) {
    const Polyhedron body = prism(n, 2, 3);
    EXPECT_EQ(check_surface(body).fault, SurfaceFault::none);
    EXPECT_NEAR(moments(body).volume, 3 * n / 2.0 * std::sin(2 * std::numbers::pi / n), 1e-12);
    EXPECT_LT(moments(body).centroid.norm(), 1e-14);
  }
  // a cube of 2 without its 12 edges (a quarter of 1/2 x 1/2 each) and 8 corners
  const Polyhedron block = eota({2, 2, 2});
  EXPECT_EQ(block.vertices.size(), 24u);
  EXPECT_EQ(n_faces(block), 26);
  EXPECT_NEAR(moments(block).volume, 17.0 / 3, 1e-12);
  Random random(7);
  for (const int n : {4, 8, 50, 300}) {
    const Polyhedron stone = rock({3, 2, 1}, n, random);
    EXPECT_EQ(check_surface(stone).fault, SurfaceFault::none);
    EXPECT_TRUE(is_convex(stone, 1e-12));
    EXPECT_LT(moments(stone).volume, std::numbers::pi);  // of the ellipsoid
    EXPECT_NEAR(moments(scaled_to(stone, 2)).volume, 2, 1e-12);
  }
}

// The published block files, coordinate by coordinate.
TEST(Shapes, TheEotaBlockIsThePublishedOne) {
  std::ifstream file(std::string(TALUS_SHARED_DIR) + "/data/blocks/eota111_1m3.off");
  if (!file) GTEST_SKIP() << "no ../shared/data";
  std::string word;
  file >> word >> word >> word >> word;
  const Polyhedron block = eota(Vec3::Constant(2 * 0.561));
  for (int v = 0; v < 24; ++v) {
    Vec3 p;
    file >> p.x() >> p.y() >> p.z();
    double nearest = 1;
    for (const Vec3& q : block.vertices) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LT(nearest, 1e-12);
  }
}

TEST(Placement, PointsAlongALineKeepTheirSpacing) {
  const auto points = points_along({{0, 0}, {3, 0}, {3, 4}}, 0.7);
  ASSERT_EQ(points.size(), 11u);
  EXPECT_LT((points[10] - Vec2(3, 4)).norm(), 1e-12);
  EXPECT_LT((points[5] - Vec2(3, 0.5)).norm(), 1e-12);
}

TEST(Placement, PointsOverAnAreaFollowTheSlopingArea) {
  const double slope = 1;  // 45 degrees: sqrt(2) times the area in plan
  const Trn ground =
      grid(41, 41, 1, [&](double x, double) { return x < 20 ? 0 : slope * (x - 20); });
  const Area whole{{{{0, 0}, {40, 0}, {40, 40}, {0, 40}}}};
  const auto points = points_over(ground, {whole}, 1.5);
  const auto n_steep =
      std::count_if(points.begin(), points.end(), [](const Vec2& p) { return p.x() > 20; });
  EXPECT_EQ(points.size(), std::round((800 + 800 * std::sqrt(2)) / 2.25));
  EXPECT_NEAR(static_cast<double>(n_steep), 800 * std::sqrt(2) / 2.25, 10);
  // of all ground, the steep part, at other places in each run
  const ReleaseArea steep{{}, 0.7};
  const auto some = points_over(ground, steep, 1.5),
             others = points_over(ground, steep, 1.5, {0.3, 0.9, 0.1});
  EXPECT_EQ(some.size(), std::round(800 * std::sqrt(2) / 2.25));
  ASSERT_EQ(others.size(), some.size());
  int n_same = 0;
  for (std::size_t i = 0; i < others.size(); ++i) {
    EXPECT_GT(some[i].x(), 20);
    n_same += triangle_at(ground, others[i].x(), others[i].y()) ==
              triangle_at(ground, some[i].x(), some[i].y());
  }
  EXPECT_LT(n_same, static_cast<int>(some.size()) / 2);
  EXPECT_NEAR(sloping_area(ground, steep).steep, 800 * std::sqrt(2), 1e-9);
  EXPECT_NEAR(sloping_area(ground, steep).all, 800 + 800 * std::sqrt(2), 1e-9);
}

// Whatever the spacing is to the cells, no part of a wall is left out: places that follow each
// other on Hilbert's curve are no farther apart than the root of 6 times the area between them.
TEST(Placement, PointsOverAnAreaLeaveNoGap) {
  const Trn wall = grid(33, 33, 2, [](double, double y) { return y; });
  const double area = sloping_area(wall, {}).steep;
  for (const double spacing : {5.0, 8.0, 9.0, 10.0, 12.0, 14.0, 20.0})
    for (const double start : {0.0, 0.4, 0.999}) {
      const auto points = points_over(wall, {}, spacing, {0.1, 0.7, start});
      const double n = std::round(area / (spacing * spacing));
      ASSERT_EQ(points.size(), n);
      std::array<int, 4> in_strip{};
      for (const Vec2& p : points) ++in_strip[std::min(3, static_cast<int>(p.x() / 16))];
      for (const int count : in_strip) EXPECT_NEAR(count, n / 4, n / 8) << spacing;
      for (double x = 0; x <= 64; ++x)
        for (double y = 0; y <= 64; ++y) {
          double nearest = 1e9;
          for (const Vec2& p : points) nearest = std::min(nearest, (p - Vec2(x, y)).norm());
          EXPECT_LT(nearest, std::sqrt(6 * 64 * 64 / n)) << spacing << " " << x << " " << y;
        }
    }
  EXPECT_EQ(points_over(wall, {}, 1000).size(), 1U);
  EXPECT_TRUE(points_over(wall, {{}, 0.8}, 1).empty());
}

// Brute force: the lower side above the ground on a fine grid of points in plan.
TEST(Placement, ClearanceIsTheSmallestGap) {
  Random random(9);
  const Trn ground = grid(21, 21, 1, [&](double, double) { return random.uniform(0, 2); });
  for (int trial = 0; trial < 20; ++trial) {
    Body body;
    body.parts = {rock({6, 4, 3}, 12, random)};
    rotate(body, random_rotation(random));
    move_by(body, {10, 10, 4});
    const double gap = clearance(body, ground);
    Body lowered = body;
    move_by(lowered, {0, 0, -gap});
    EXPECT_NEAR(clearance(lowered, ground), 0, 1e-12);
    double sampled = 1e9;
    const Polyhedron& part = body.parts[0];
    for (double x = 5; x < 15; x += 0.05)
      for (double y = 5; y < 15; y += 0.05) {
        double low = -1e9, high = 1e9;
        for (int f = 0; f < n_faces(part); ++f) {
          const Vec3 n = face_normal(part, f);
          const double z = (n.dot(part.vertices[face(part, f)[0]]) - n.x() * x - n.y() * y) / n.z();
          if (n.z() < 0)
            low = std::max(low, z);
          else
            high = std::min(high, z);
        }
        if (low <= high) sampled = std::min(sampled, low - elevation_at(ground, x, y));
      }
    EXPECT_LE(gap, sampled + 1e-9);
    EXPECT_GT(gap, sampled - 0.15);
  }
}
