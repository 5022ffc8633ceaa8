// libcore/geometry/face_pressure.hpp: public
// The resultant of a pressure on plane polygons: exact where the pressure is linear, and none where
// it would be below zero.
// theory: docs/theory/theory.md 1.14
#pragma once

#include <array>
#include <functional>
#include <span>

#include "base/types.hpp"

namespace talus {

/// Force of a pressure against a face, and the point that it acts on.
struct FacePressure {
  double force = 0;                  ///< integral of p [N]
  Vec3 first_moment = Vec3::Zero();  ///< integral of p x [N m]

  /// Centre of pressure; only where `force` is above 0 [m].
  [[nodiscard]] Vec3 centre() const { return first_moment / force; }
};

/// Adds the pressure on a triangle, linear between those at its corners [Pa], where it is positive.
void add_pressure(const std::array<Vec3, 3>& corner, const Vec3& pressure, FacePressure& sum);

/// Pressure on a convex polygon that is `pressure_at` its points [Pa]. Exact where that is linear
/// over triangles whose sides are at most `resolution` long; infinite: over the polygon.
[[nodiscard]] FacePressure pressure_on(std::span<const Vec3> polygon, double resolution,
                                       const std::function<double(const Vec3&)>& pressure_at);

}  // namespace talus
