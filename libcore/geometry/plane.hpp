// libcore/geometry/plane.hpp: public
// Oriented planes: n . x = d, the inside is where n . x < d.
#pragma once

#include "base/types.hpp"

namespace talus {

struct Plane {
  Vec3 normal = Vec3::UnitZ();  ///< unit length, points out of the half-space that is kept
  double offset = 0;            ///< d in n . x = d [m]
};

/// Signed distance, > 0 outside, that is on the side that the normal points to [m].
[[nodiscard]] inline double distance(const Plane& plane, const Vec3& point) {
  return plane.normal.dot(point) - plane.offset;
}

[[nodiscard]] inline Plane plane_through(const Vec3& point, const Vec3& unit_normal) {
  return {unit_normal, unit_normal.dot(point)};
}

[[nodiscard]] inline Plane flipped(const Plane& plane) { return {-plane.normal, -plane.offset}; }

}  // namespace talus
