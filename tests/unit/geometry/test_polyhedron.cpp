// Polyhedra: moments, checks, triangles, cuts.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "geometry/polyhedron.hpp"
#include "geometry/triangulate.hpp"

namespace {

using talus::Mat3;
using talus::Moments;
using talus::Plane;
using talus::Polyhedron;
using talus::Random;
using talus::SurfaceFault;
using talus::Vec3;

constexpr double tolerance = 1e-9;

Vec3 random_direction(Random& random) {
  return Vec3(random.normal(), random.normal(), random.normal()).normalized();
}

// A box cut at random: convex, many-sided, never empty.
Polyhedron random_convex(Random& random, int n_cuts) {
  Polyhedron body = talus::box({-1, -1.5, -2}, {1, 1.5, 2}, 7);
  for (int k = 0; k < n_cuts; ++k)
    body = talus::clip_convex(body, {random_direction(random), random.uniform(0.3, 1.5)}, k,
                              tolerance);
  return body;
}

void transform(Polyhedron& body, const Mat3& rotation, const Vec3& shift) {
  for (Vec3& v : body.vertices) v = rotation * v + shift;
}

}  // namespace

TEST(Moments, OfARotatedBoxAreTheClosedForm) {
  Random random(1);
  const Vec3 half(0.5, 1.25, 3);
  const Vec3 m = half.cwiseAbs2() / 3;  // mean square of each coordinate
  for (int trial = 0; trial < 50; ++trial) {
    Polyhedron body = talus::box(-half, half);
    const Mat3 rotation =
        Eigen::AngleAxisd(random.uniform(0, 6), random_direction(random)).toRotationMatrix();
    const Vec3 shift(random.uniform(-900, 900), random.uniform(-900, 900), 500);
    transform(body, rotation, shift);
    const Moments found = talus::moments(body);
    const double volume = 8 * half.prod();
    const Mat3 second = volume * rotation * m.asDiagonal() * rotation.transpose();
    EXPECT_NEAR(found.volume, volume, 1e-12 * volume * 100);
    EXPECT_LT((found.centroid - shift).norm(), 1e-11);
    EXPECT_LT((found.second - second).norm(), 1e-11 * second.norm());
  }
}

TEST(Extents, AreTheEdgesOfATurnedBox) {
  Random random(12);
  Polyhedron body = talus::box({0, 0, 0}, {2, 0.5, 7});
  const Mat3 turn = Eigen::AngleAxisd(1.1, random_direction(random)).toRotationMatrix();
  transform(body, turn, {40, -3, 9});
  EXPECT_LT((talus::extents(talus::moments(body)) - Vec3(7, 2, 0.5)).norm(), 1e-11);
}

TEST(Moments, OfATetrahedronAreTheClosedForm) {
  Polyhedron body;
  body.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& loop : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
    talus::add_face(body, loop, 0);
  const Moments found = talus::moments(body);
  EXPECT_NEAR(found.volume, 1.0 / 6, 1e-16);
  EXPECT_LT((found.centroid - Vec3::Constant(0.25)).norm(), 1e-15);
  // integral of x^2 = 1/60, of x y = 1/120; minus V/16
  EXPECT_NEAR(found.second(0, 0), 1.0 / 60 - 1.0 / 96, 1e-16);
  EXPECT_NEAR(found.second(0, 1), 1.0 / 120 - 1.0 / 96, 1e-16);
}

// Both halves of a cut, taken together, are the whole; and each is closed, outward and convex.
TEST(ClipConvex, HalvesAddUpAndStaySound) {
  Random random(2);
  for (int trial = 0; trial < 400; ++trial) {
    const Polyhedron body = random_convex(random, trial % 9);
    const Plane plane = {random_direction(random), random.uniform(-0.25, 0.25)};
    const Polyhedron inner = talus::clip_convex(body, plane, 100, tolerance);
    const Polyhedron outer = talus::clip_convex(body, talus::flipped(plane), 100, tolerance);
    const Moments whole = talus::moments(body);
    const Moments sum = talus::joined(talus::moments(inner), talus::moments(outer));
    EXPECT_NEAR(sum.volume, whole.volume, 1e-12 * whole.volume);
    EXPECT_LT((sum.centroid - whole.centroid).norm(), 1e-12);
    EXPECT_LT((sum.second - whole.second).norm(), 1e-11 * whole.second.norm());
    for (const Polyhedron* half : {&inner, &outer}) {
      const talus::SurfaceCheck check = talus::check_surface(*half);
      EXPECT_EQ(check.fault, SurfaceFault::none) << text(check.fault) << ", trial " << trial;
      EXPECT_EQ(check.euler, std::vector<int>{2});
      EXPECT_TRUE(talus::is_convex(*half, 10 * tolerance));
      EXPECT_EQ(std::count(half->face_tag.begin(), half->face_tag.end(), 100), 1);
    }
  }
}

// Engineers' joints: planes through faces, edges and corners of the body that they cut.
TEST(ClipConvex, PlanesThroughFacesEdgesAndCornersAddNoDust) {
  const Polyhedron cube = talus::box({0, 0, 0}, {1, 1, 1});
  const double diagonal = std::sqrt(0.5);
  const auto volume_inside = [&](const Plane& plane) {
    const Polyhedron part = talus::clip_convex(cube, plane, 1, tolerance);
    if (talus::n_faces(part) > 0) {
      EXPECT_EQ(talus::check_surface(part).fault, SurfaceFault::none);
    }
    return talus::moments(part).volume;
  };
  EXPECT_EQ(volume_inside({Vec3::UnitX(), 1}), 1);      // through a face, cube inside
  EXPECT_EQ(volume_inside({-Vec3::UnitX(), -1}), 0);    // through a face, cube outside
  EXPECT_EQ(volume_inside({Vec3::UnitX(), 1e-10}), 0);  // less than the tolerance is left
  EXPECT_NEAR(volume_inside({Vec3(diagonal, diagonal, 0), diagonal}), 0.5, 1e-15);  // two edges
  EXPECT_EQ(volume_inside({Vec3(-diagonal, -diagonal, 0), 0}), 1);                  // one edge
  EXPECT_EQ(volume_inside({Vec3(diagonal, diagonal, 0), 0}), 0);
  const Vec3 corner = Vec3::Constant(1 / std::sqrt(3.0));
  EXPECT_NEAR(volume_inside({corner, corner.x()}), 1.0 / 6, 1e-15);  // three corners
}

TEST(CheckSurface, NamesEachFault) {
  const Polyhedron cube = talus::box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(talus::check_surface(cube).fault, SurfaceFault::none);

  Polyhedron open = cube;
  open.face_begin.pop_back(), open.face_tag.pop_back(), open.face_vertices.resize(20);
  EXPECT_EQ(talus::check_surface(open).fault, SurfaceFault::open);

  Polyhedron inverted = cube;
  for (int f = 0; f < 6; ++f)
    std::reverse(inverted.face_vertices.begin() + 4 * f,
                 inverted.face_vertices.begin() + 4 * f + 4);
  EXPECT_EQ(talus::check_surface(inverted).fault, SurfaceFault::inside_out);

  Polyhedron twisted = cube;
  std::reverse(twisted.face_vertices.begin(), twisted.face_vertices.begin() + 4);
  EXPECT_EQ(talus::check_surface(twisted).fault, SurfaceFault::not_oriented);

  Polyhedron flat = cube;
  for (Vec3& v : flat.vertices) v.z() = 0;
  EXPECT_EQ(talus::check_surface(flat).fault, SurfaceFault::flat);

  Polyhedron doubled = cube;
  talus::add_face(doubled, talus::face(cube, 0), 0);
  EXPECT_EQ(talus::check_surface(doubled).fault, SurfaceFault::not_manifold);

  Polyhedron stray = cube;
  stray.face_vertices[3] = 8;
  EXPECT_EQ(talus::check_surface(stray).fault, SurfaceFault::bad_index);
  stray.face_vertices[3] = stray.face_vertices[2];
  EXPECT_EQ(talus::check_surface(stray).fault, SurfaceFault::repeated);
}

TEST(CheckSurface, CountsShellsAndTheirEulerNumbers) {
  Polyhedron two = talus::box({0, 0, 0}, {1, 1, 1});
  const Polyhedron other = talus::box({2, 0, 0}, {3, 1, 1});
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (int f = 0; f < 6; ++f) {
    std::vector<int> loop(talus::face(other, f).begin(), talus::face(other, f).end());
    for (int& v : loop) v += 8;
    talus::add_face(two, loop, 0);
  }
  const talus::SurfaceCheck check = talus::check_surface(two);
  EXPECT_EQ(check.fault, SurfaceFault::none);
  EXPECT_EQ(check.euler, (std::vector<int>{2, 2}));
}

TEST(Edges, OfACubeAreTwelveWithTheirTwoFaces) {
  const Polyhedron cube = talus::box({0, 0, 0}, {1, 2, 3});
  const auto found = talus::edges(cube);
  ASSERT_EQ(found.size(), 12u);
  for (const auto& edge : found) {
    ASSERT_GE(edge.left, 0);
    ASSERT_GE(edge.right, 0);
    const Vec3 along = cube.vertices[edge.b] - cube.vertices[edge.a];
    // the left face runs through a -> b: its normal times the edge points into the face
    const Vec3 inward = talus::face_normal(cube, edge.left).cross(along);
    EXPECT_GT(inward.dot(talus::face_centroid(cube, edge.left) - cube.vertices[edge.a]), 0);
  }
  EXPECT_EQ(talus::shortest_edge(cube), 1);
}

// Ears of an outline with many reflex corners: they add up to its area and all turn in its sense.
TEST(TrianglesOfFace, FillNonConvexFaces) {
  Random random(6);
  for (int trial = 0; trial < 200; ++trial) {
    Polyhedron body;
    const int n = 4 + trial % 30;
    std::vector<int> loop;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n, radius = random.uniform(0.1, 1);
      body.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 3);
      loop.push_back(k);
    }
    talus::add_face(body, loop, 0);
    const auto triangles = talus::triangles_of_face(body, 0);
    ASSERT_EQ(triangles.size(), static_cast<size_t>(n - 2));
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
      const Vec3 u = body.vertices[b] - body.vertices[a], v = body.vertices[c] - body.vertices[a];
      const double twice = u.x() * v.y() - u.y() * v.x();
      EXPECT_GT(twice, 0);
      area += twice / 2;
    }
    EXPECT_NEAR(area, talus::face_area(body, 0), 1e-12);
  }
}

TEST(FaceCentroid, OfANonConvexFaceIsItsCentreOfArea) {
  Polyhedron body;  // an L of three unit squares
  body.vertices = {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}};
  talus::add_face(body, std::array{0, 1, 2, 3, 4, 5}, 0);
  EXPECT_NEAR(talus::face_area(body, 0), 3, 1e-15);
  EXPECT_LT((talus::face_centroid(body, 0) - Vec3(2.5 / 3, 2.5 / 3, 1)).norm(), 1e-15);
}

// Four boxes around one edge, with common vertices, some of their faces lying on each other: the
// eight faces at the edge pair up by box.
TEST(Edges, FacesAboutACommonEdgePairUpByBody) {
  using namespace talus;
  Polyhedron all;
  for (int k = 0; k < 4; ++k) {
    const Vec3 low(k & 1, k >> 1, 0);
    const Polyhedron one = box(low, low + Vec3::Ones(), k);
    for (int f = 0; f < n_faces(one); ++f) {
      std::vector<int> loop;
      for (const int v : face(one, f)) {
        const auto known = std::find(all.vertices.begin(), all.vertices.end(), one.vertices[v]);
        loop.push_back(static_cast<int>(known - all.vertices.begin()));
        if (known == all.vertices.end()) all.vertices.push_back(one.vertices[v]);
      }
      add_face(all, loop, k);
    }
  }
  int n_at_the_edge = 0;
  for (const PolyhedronEdge& edge : edges(all)) {
    EXPECT_EQ(all.face_tag[edge.left], all.face_tag[edge.right]);
    n_at_the_edge += all.vertices[edge.a].head<2>() == Vec2(1, 1) &&
                     all.vertices[edge.b].head<2>() == Vec2(1, 1);
  }
  EXPECT_EQ(n_at_the_edge, 4);
}
