// libcore/contact/entrance.hpp
// Exact local entrance tests: whether two convex features can be the ones through which two bodies
// first touch, that is, whether they give a face of the entrance block (Minkowski difference).
// theory 2.2; paper: Sect. 3, "Identification of the entrance plane"
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

#include "base/types.hpp"

namespace talus {

/// V-F: a vertex enters through a face with outward normal `normal` when none of the vertex's
/// neighbours lies behind the plane through it; `tolerance` is a length [m].
[[nodiscard]] inline bool vertex_may_enter(const Vec3& vertex, std::span<const Vec3> neighbours,
                                           const Vec3& normal, double tolerance) {
  for (const Vec3& neighbour : neighbours)
    if ((neighbour - vertex).dot(normal) < -tolerance) return false;
  return true;
}

/// Direction of an edge between two faces with outward normals n1 and n2, unit.
[[nodiscard]] inline Vec3 edge_along(const Vec3& n1, const Vec3& n2) {
  return n2.cross(n1).normalized();
}

/// E-E: edges of A and B, each between two faces with outward normals a1, a2 and b1, b2. True when
/// the arc a1-a2 crosses the arc of the negatives of b1, b2 on the sphere of normals, or an end of
/// one arc lies within `tolerance` (sine of an angle) of the other: a face that rests on an edge of
/// the other body touches it through two of its own edges, and is never parallel to rounding. Flat
/// edges have no arc, concave ones a reversed one: leave both out.
/// `along_b` = edge_along(b1, b2), which a search over the edges of A computes once.
[[nodiscard]] inline bool edges_may_touch(const Vec3& a1, const Vec3& a2, const Vec3& b1,
                                          const Vec3& b2, const Vec3& along_b, double tolerance) {
  const auto crosses = [&](double s, double t) {
    return std::min(s, t) <= tolerance && std::max(s, t) >= -tolerance;
  };
  const double a = a1.dot(along_b), b = a2.dot(along_b);
  if (!crosses(a, b)) return false;
  const Vec3 along_a = edge_along(a1, a2);
  const double c = -b1.dot(along_a), d = -b2.dot(along_a);
  return crosses(c, d) && (c - d) * (b - a) > 0;
}

/// The points of two lines that are nearest to each other: p + s e, q + t f.
struct LinePair {
  double s = 0, t = 0;
  bool parallel = false;  ///< |e x f| below sin(1 degree) |e| |f|: s and t mean nothing
};
[[nodiscard]] inline LinePair nearest_on_lines(const Vec3& p, const Vec3& e, const Vec3& q,
                                               const Vec3& f) {
  const double ee = e.squaredNorm(), ff = f.squaredNorm(), ef = e.dot(f);
  const double cross_sq = ee * ff - ef * ef;
  constexpr double sin_sq = 3.046e-4;  // of 1 degree
  if (!(cross_sq > sin_sq * ee * ff)) return {0, 0, true};
  const Vec3 d = q - p;
  const double de = d.dot(e), df = d.dot(f);
  return {(de * ff - df * ef) / cross_sq, (de * ef - df * ee) / cross_sq, false};
}

}  // namespace talus
