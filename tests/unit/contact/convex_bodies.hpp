// tests/unit/contact/convex_bodies.hpp
// Bodies for the tests of block contacts, and brute force to compare with.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <random>
#include <vector>

#include "contact/block_pairs.hpp"
#include "geometry/polyhedron.hpp"

namespace talus::test {

using Draws = std::mt19937_64;

inline double uniform(Draws& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Drawn one by one: the order in which a call's arguments are drawn would be the compiler's.
inline Vec3 direction(Draws& random) {
  std::normal_distribution<double> normal;
  const double z = normal(random), y = normal(random), x = normal(random);
  return Vec3(x, y, z).normalized();
}

inline Quat attitude(Draws& random) {
  std::normal_distribution<double> normal;
  const double z = normal(random), y = normal(random), x = normal(random), w = normal(random);
  return Quat(w, x, y, z).normalized();
}

/// A box of the given half sides with some of it cut off by random planes.
inline Polyhedron convex_body(Draws& random, const Vec3& half, int n_cuts) {
  Polyhedron body = box(-half, half);
  for (int k = 0; k < n_cuts; ++k) {
    const Vec3 n = direction(random);
    const double reach = n.cwiseAbs().dot(half);
    body = clip_convex(body, {n, uniform(random, 0.45, 0.95) * reach}, 0, 1e-6 * half.minCoeff());
  }
  return body;
}

/// A box whose lower edge along x is cut off by a face 0.04 mm wide.
inline Polyhedron box_with_sliver(const Vec3& half) {
  const Vec3 n = Vec3(0, 1, -1).normalized();
  const double width = 4e-5;
  return clip_convex(box(-half, half), {n, n.cwiseAbs().dot(half) - width / 2}, 0, 1e-9);
}

/// Hulls and poses of a few bodies, each of one part about its own origin.
struct Bodies {
  Hulls hulls;
  std::vector<Pose> poses;
  PlacedHulls placed;
};

inline void add(Bodies& bodies, std::span<const Polyhedron> parts, const Pose& pose) {
  add_hulls(bodies.hulls, parts, Vec3::Zero(), Mat3::Identity());
  bodies.poses.push_back(pose);
}
inline void add(Bodies& bodies, const Polyhedron& part, const Pose& pose) {
  add(bodies, std::span(&part, 1), pose);
}
inline void place(Bodies& bodies) {
  place_hulls(bodies.hulls, bodies.poses, {}, {}, bodies.placed);
}

inline int n_vertices(const Hulls& hulls, int p) {
  return hulls.vertex_begin[p + 1] - hulls.vertex_begin[p];
}

/// Separation of two parts along a unit normal from B to A; negative: overlap.
inline double separation_along(const Hulls& hulls, const PlacedHulls& placed, int a, int b,
                               const Vec3& normal) {
  double lowest_a = std::numeric_limits<double>::infinity(), highest_b = -lowest_a;
  for (int v = 0; v < n_vertices(hulls, a); ++v)
    lowest_a = std::min(lowest_a, normal.dot(placed.vertices[hulls.vertex_begin[a] + v]));
  for (int v = 0; v < n_vertices(hulls, b); ++v)
    highest_b = std::max(highest_b, normal.dot(placed.vertices[hulls.vertex_begin[b] + v]));
  return lowest_a - highest_b;
}

/// Largest separation over all face normals and all products of edges, in both directions: minus
/// the penetration depth of parts that overlap, since the faces of the Minkowski difference are
/// among them.
inline double brute_separation(const Hulls& hulls, const PlacedHulls& placed, int a, int b) {
  double best = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& n) {
    best = std::max(best, separation_along(hulls, placed, a, b, n));
  };
  for (int f = 0; f < hulls.n_faces[a]; ++f) consider(-normal_at(placed, hulls.face_begin[a] + f));
  for (int f = 0; f < hulls.n_faces[b]; ++f) consider(normal_at(placed, hulls.face_begin[b] + f));
  const auto along = [&](int p, int e) {
    const HullEdge& edge = hulls.edges[hulls.edge_begin[p] + e];
    return Vec3(placed.vertices[hulls.vertex_begin[p] + edge.b] -
                placed.vertices[hulls.vertex_begin[p] + edge.a]);
  };
  for (int i = 0; i < hulls.edge_begin[a + 1] - hulls.edge_begin[a]; ++i)
    for (int k = 0; k < hulls.edge_begin[b + 1] - hulls.edge_begin[b]; ++k) {
      const Vec3 u = along(a, i), v = along(b, k), n = u.cross(v);
      if (n.norm() < 1e-9 * u.norm() * v.norm()) continue;
      consider(n.normalized());
      consider(-n.normalized());
    }
  return best;
}

/// How far a point lies outside a part; negative inside.
inline double outside_by(const Hulls& hulls, const PlacedHulls& placed, int p, const Vec3& point) {
  double most = -std::numeric_limits<double>::infinity();
  for (int f = hulls.face_begin[p]; f < hulls.face_begin[p] + hulls.n_faces[p]; ++f)
    most = std::max(most, normal_at(placed, f).dot(point) - placed.offset[f]);
  return most;
}

/// Moves B along `normal` (from B to A) until the parts overlap by `depth` along it.
inline void press(Bodies& bodies, int a, int b, const Vec3& normal, double depth) {
  const double gap = separation_along(bodies.hulls, bodies.placed, a, b, normal);
  bodies.poses[bodies.hulls.body[b]].position += (gap + depth) * normal;
  place(bodies);
}

}  // namespace talus::test
