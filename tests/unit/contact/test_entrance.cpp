// Entrance tests of features against the Minkowski difference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "contact/entrance.hpp"
#include "geometry/polyhedron.hpp"

namespace {

using namespace talus;
using Quat = Eigen::Quaterniond;

// A box cut by random planes: convex, up to a dozen faces.
Polyhedron random_convex(talus::Random& random) {
  Polyhedron body = box(Vec3::Constant(-1), Vec3::Constant(1));
  for (int i = 0; i < 5; ++i) {
    const Vec3 n = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    body = clip_convex(body, {n, random.uniform(0.6, 1.2)}, 0, 1e-9);
  }
  Quat q(random.normal(), random.normal(), random.normal(), random.normal());
  for (Vec3& v : body.vertices) v = q.normalized() * v;
  return body;
}

struct Entrance {
  Vec3 normal;  // from B to A
  double area;
  double value;  // n . (a - b) of the features
};

// All entrances of A into B by the tests of theory 2.2.
std::vector<Entrance> entrances(const Polyhedron& A, const Polyhedron& B) {
  std::vector<Entrance> found;
  const auto vertex_face = [&](const Polyhedron& V, const Polyhedron& F, double sign) {
    const std::vector<PolyhedronEdge> all = edges(V);
    for (int f = 0; f < n_faces(F); ++f)
      for (int v = 0; v < static_cast<int>(V.vertices.size()); ++v) {
        std::vector<Vec3> ring;
        for (const PolyhedronEdge& e : all) {
          if (e.a == v) ring.push_back(V.vertices[static_cast<std::size_t>(e.b)]);
          if (e.b == v) ring.push_back(V.vertices[static_cast<std::size_t>(e.a)]);
        }
        const Vec3 n = face_normal(F, f), x = V.vertices[static_cast<std::size_t>(v)];
        if (ring.empty() || !vertex_may_enter(x, ring, n, 0)) continue;
        found.push_back({sign * n, face_area(F, f), n.dot(x - face_centroid(F, f))});
      }
  };
  vertex_face(A, B, 1);
  vertex_face(B, A, -1);
  for (const PolyhedronEdge& a : edges(A))
    for (const PolyhedronEdge& b : edges(B)) {
      const GaussArc arc_a = gauss_arc(face_normal(A, a.left), face_normal(A, a.right));
      const GaussArc arc_b = gauss_arc(face_normal(B, b.left), face_normal(B, b.right));
      if (!edges_may_touch(arc_a, arc_b, 0)) continue;
      const Vec3& p = A.vertices[static_cast<std::size_t>(a.a)];
      const Vec3& q = B.vertices[static_cast<std::size_t>(b.a)];
      Vec3 n = (A.vertices[static_cast<std::size_t>(a.b)] - p)
                   .cross(B.vertices[static_cast<std::size_t>(b.b)] - q);
      const double area = n.norm();
      n /= area;
      if (n.dot(arc_b.left + arc_b.right) < 0) n = -n;
      found.push_back({n, area, n.dot(p - q)});
    }
  return found;
}

// The entrances are the faces of B (+) (-A): each plane supports that body, and together they close
// it (their area vectors add up to nothing), so that none is missing and none is too many.
TEST(Entrance, FacesAreThoseOfTheMinkowskiDifference) {
  talus::Random random(11, "entrance");
  for (int trial = 0; trial < 20; ++trial) {
    const Polyhedron A = random_convex(random), B = random_convex(random);
    Vec3 closure = Vec3::Zero();
    double area = 0;
    for (const Entrance& e : entrances(A, B)) {
      double lowest = 1e300;
      for (const Vec3& a : A.vertices)
        for (const Vec3& b : B.vertices) lowest = std::min(lowest, e.normal.dot(a - b));
      EXPECT_NEAR(e.value, lowest, 1e-9);
      closure += e.area * e.normal;
      area += e.area;
    }
    EXPECT_LT(closure.norm(), 1e-9 * area);
  }
}

TEST(NearestOnLines, IsPerpendicularToBoth) {
  talus::Random random(3, "lines");
  for (int trial = 0; trial < 100; ++trial) {
    const auto point = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
    const Vec3 p = point(), e = point(), q = point(), f = point();
    const LinePair at = nearest_on_lines(p, e, q, f);
    ASSERT_FALSE(at.parallel);
    const Vec3 between = p + at.s * e - q - at.t * f;
    EXPECT_NEAR(between.dot(e), 0, 1e-9);
    EXPECT_NEAR(between.dot(f), 0, 1e-9);
  }
  EXPECT_TRUE(
      nearest_on_lines(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3(1, 0.01, 0)).parallel);
}

}  // namespace
