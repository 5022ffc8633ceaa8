// libcore/geometry/plan2d.hpp: public
// Points, segments and rings in plan.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "base/types.hpp"

namespace talus {

/// Twice the area of the triangle 0, a, b; positive when b is to the left of a.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Share of the segment from `a` to `b`, 0 to 1, at its point nearest to `p`; 0 for a segment of no
/// length. In plan (Vec2) or in space (Vec3).
template <class Point>
[[nodiscard]] double share_along_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double length_sq = along.squaredNorm();
  return length_sq > 0 ? std::clamp((p - a).dot(along) / length_sq, 0.0, 1.0) : 0.0;
}

/// Distance of `p` from the segment between `a` and `b`, in plan (Vec2) or in space (Vec3) [m].
template <class Point>
[[nodiscard]] double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  return (p - a - share_along_segment<Point>(p, a, b) * (b - a)).norm();
}

/// The ray from `p` to the east crosses the side from `a` to `b`.
[[nodiscard]] inline bool is_left_of(const Vec2& a, const Vec2& b, const Vec2& p) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

/// `p` lies inside the ring, whose first point is not repeated, by the even-odd rule. A point on
/// the border may count as inside or outside.
[[nodiscard]] inline bool is_inside(std::span<const Vec2> ring, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if (is_left_of(ring[i], ring[j], p)) inside = !inside;
  return inside;
}

/// Area in plan of a ring whose first point is not repeated; positive when it runs
/// counter-clockwise. Points in plan (Vec2) or in space (Vec3) [m2].
template <class Points>
[[nodiscard]] double ring_area(const Points& ring) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Vec2 a = (ring[k] - ring[0]).template head<2>();
    const Vec2 b = (ring[k + 1] - ring[0]).template head<2>();
    twice += cross(a, b);
  }
  return twice / 2;
}

/// Length of an open line [m].
[[nodiscard]] inline double length_of(std::span<const Vec2> line) {
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  return length;
}

}  // namespace talus
