// libcore/blocks/area_side.hpp
// A side of an outline and a point in plan.
#pragma once

#include <cmath>

#include "base/types.hpp"

namespace talus {

inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Within a billionth of its length.
inline bool on_segment(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 along = b - a;
  const double length_sq = along.squaredNorm();
  if (length_sq == 0) return (p - a).squaredNorm() == 0;
  const double t = (p - a).dot(along) / length_sq;
  return t >= 0 && t <= 1 && std::abs(cross(along, p - a)) <= 1e-9 * length_sq;
}

/// How far from a segment on_segment() may hold, and more.
inline double reach_of(const Vec2& a, const Vec2& b) { return 2e-9 * (b - a).norm(); }

/// The ray to the east from `p` crosses the side.
inline bool is_left_of(const Vec2& a, const Vec2& b, const Vec2& p) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

}  // namespace talus
