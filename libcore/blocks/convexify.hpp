// libcore/blocks/convexify.hpp
// Makes a block convex inside its joint cell: the bed is kept clear of by supporting planes, the
// volume is kept by the height of one plane on the terrain side.
#pragma once

#include <vector>

#include "geometry/polyhedron.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A block as it was cut, and the room that it may take.
struct ConvexTask {
  Polyhedron room;                     ///< convex: joint cell, cut off from other blocks in it
  Vec3 low, high;                      ///< box of the block as it was cut [m]
  Vec3 terrain_normal = Vec3::Zero();  ///< upward, mean over its terrain faces; zero: it has none
  double terrain_support = 0;          ///< largest terrain_normal . x over its vertices [m]
  Vec3 bed_normal = Vec3::Zero();      ///< upward, mean over its bed faces; zero: it has none
  double volume = 0;                   ///< to be kept [m3]
  double height = 0;  ///< its extent along terrain_normal: how far the top may rise [m]
};

/// The convex block; without faces when nothing of it is left. Its volume is that of the task where
/// the room allows. Lies above `bed` everywhere to within `tolerance_m`, and within the room. Faces
/// on the terrain side carry face_terrain, those on the bed face_failure, the others their tag.
[[nodiscard]] Polyhedron made_convex(const ConvexTask& task, const Trn& bed, double tolerance_m);

}  // namespace talus
