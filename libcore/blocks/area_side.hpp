// libcore/blocks/area_side.hpp
// A side of an outline and a point in plan.
#pragma once

#include <cmath>

#include "geometry/plan2d.hpp"

namespace talus {

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

}  // namespace talus
