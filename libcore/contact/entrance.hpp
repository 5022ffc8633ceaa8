// libcore/contact/entrance.hpp: public
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

/// A convex edge on the sphere of normals: the arc between the outward unit normals of its faces.
/// Flat edges have no arc.
struct GaussArc {
  Vec3 left, right;
  Vec3 along;  ///< unit, normal to both
};

[[nodiscard]] inline GaussArc gauss_arc(const Vec3& left, const Vec3& right) {
  return {left, right, right.cross(left).normalized()};
}

/// E-E: edges of A and B. True when the arc of A crosses the negative of the arc of B, or an end of
/// one arc lies within `tolerance` (sine of an angle) of the other: a face that rests on an edge of
/// the other body touches it through two of its own edges, and is never parallel to rounding.
/// Concave edges have a reversed arc: leave them out. `turned`: also true where it may become true
/// once the bodies have turned towards each other by an angle of that chord.
[[nodiscard]] inline bool edges_may_touch(const GaussArc& arc_a, const GaussArc& arc_b,
                                          double tolerance, double turned = 0) {
  const double c = -arc_b.left.dot(arc_a.along), d = -arc_b.right.dot(arc_a.along);
  const double a = arc_a.left.dot(arc_b.along), b = arc_a.right.dot(arc_b.along);
  // numbers instead of branches: which of many edges it is cannot be foreseen
  const auto crosses = [&](double s, double t) {
    const int begins = std::min(s, t) <= tolerance + turned,
              ends = std::max(s, t) >= -(tolerance + turned);
    return begins & ends;
  };
  // each difference is at most 2 and changes by at most 2 turned
  const int same_way = (c - d) * (b - a) > -turned * (8 + 4 * turned);
  return (crosses(c, d) & crosses(a, b) & same_way) != 0;
}

/// sin^2 of 1 degree: directions nearer than that count as parallel.
inline constexpr double parallel_sin_sq = 3.0458649045213493e-4;
/// sin^2 of 0.005 degrees: for edges nearer to parallel, the direction across both is rounding of
/// their vertices.
inline constexpr double no_crossing_sin_sq = 7.6e-9;
/// Edges parallel within a degree are an axis where no face is nearer to their direction than 8
/// degrees.
inline constexpr double no_face_cos = 0.990268068741570;

/// Whether a unit normal across an edge lies in its arc, farther than 8 degrees from both faces.
[[nodiscard]] inline bool is_well_inside(const GaussArc& arc, const Vec3& normal) {
  const double left = normal.dot(arc.left), right = normal.dot(arc.right);
  return left + right > 1 + arc.left.dot(arc.right) && std::max(left, right) < no_face_cos;
}

/// The points of two lines that are nearest to each other: p + s e, q + t f.
struct LinePair {
  double s = 0, t = 0;
  bool parallel = false;  ///< |e x f|^2 below `sin_sq` |e|^2 |f|^2: s and t mean nothing
};
[[nodiscard]] inline LinePair nearest_on_lines(const Vec3& p, const Vec3& e, const Vec3& q,
                                               const Vec3& f, double sin_sq = parallel_sin_sq) {
  const double ee = e.squaredNorm(), ff = f.squaredNorm(), ef = e.dot(f);
  const double cross_sq = ee * ff - ef * ef;
  if (!(cross_sq > sin_sq * ee * ff)) return {0, 0, true};
  const Vec3 d = q - p;
  const double de = d.dot(e), df = d.dot(f);
  return {(de * ff - df * ef) / cross_sq, (de * ef - df * ee) / cross_sq, false};
}

/// Where two lines that are not parallel cross when seen along `view`; not finite when they never
/// do.
[[nodiscard]] inline LinePair crossing_seen_along(const Vec3& view, const Vec3& p, const Vec3& e,
                                                  const Vec3& q, const Vec3& f) {
  const Vec3 d = q - p, across = e.cross(f);
  const double per = 1 / view.dot(across);
  return {view.dot(d.cross(f)) * per, view.dot(d.cross(e)) * per, false};
}

/// Whether a pair of points lies between the ends of both lines; `beyond`: or so far beyond an end
/// of the second one, in its lengths.
[[nodiscard]] inline bool is_within(const LinePair& at, double beyond = 0) {
  return at.s >= 0 && at.s <= 1 && at.t >= -beyond && at.t <= 1 + beyond;
}

}  // namespace talus
