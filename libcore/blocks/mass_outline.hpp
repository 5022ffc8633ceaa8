// libcore/blocks/mass_outline.hpp: public
// Where rock lies above a failure plane, or above the higher of several, in plan.
// in:    the TRN, the polygon of the source, planes
// out:   convex pieces with their volumes, exact: the ground is plane within each
#pragma once

#include <vector>

#include "blocks/area.hpp"
#include "blocks/joint_sets.hpp"
#include "terrain/trn.hpp"

namespace talus {

struct PlaneThrough {
  Attitude attitude;
  Vec3 point = Vec3::Zero();  ///< local [m]
};

struct MassPiece {
  std::vector<Vec2> outline;  ///< convex, counter-clockwise, local [m]
  int plane = 0;              ///< that it lies on
  double volume = 0;          ///< [m3]
};

/// Pieces meet edge to edge up to rounding. The area must lie on the grid.
[[nodiscard]] std::vector<MassPiece> mass_above(const Trn& ground, const Area& area,
                                                const std::vector<PlaneThrough>& planes);

}  // namespace talus
