// libcore/geometry/face_overlap.hpp: public
// The part that two faces lying against each other have in common, for faces that hide one another
// inside a body and for joint faces between blocks.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// Common part of two convex polygons.
struct FaceOverlap {
  double area = 0;             ///< [m2]
  Vec3 centre = Vec3::Zero();  ///< centre of area, in the plane of the first face [m]
  std::vector<Vec3> outline;   ///< in that plane [m]; empty without area
};

/// Overlap of polygon `one` (counter-clockwise about its unit normal) with `other`, which is
/// projected along that normal; the other may turn in either sense. Planar and convex within
/// rounding.
[[nodiscard]] FaceOverlap face_overlap(std::span<const Vec3> one, const Vec3& normal,
                                       std::span<const Vec3> other);

}  // namespace talus
