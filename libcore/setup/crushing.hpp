// libcore/setup/crushing.hpp
// Load through a block at which it is crushed: the strength of a lump between two points.
// in:    the blocks as cut, the strength of their rock
// out:   Scene::crush_load
// ISRM 1985 (point load strength) and Brook 1985, Int. J. Rock Mech. Min. Sci. 22(2): a lump fails
// at P = I_s D_e^2, with I_s = I_s50 (D_e / 50 mm)^-0.45 and pi D_e^2 / 4 the least section between
// the points. The uniaxial strength is 22 to 24 times I_s50.
#pragma once

#include <span>
#include <vector>

#include "blocks/block_set.hpp"
#include "geometry/polyhedron.hpp"
#include "scene/scene.hpp"

namespace talus {

/// Load at which a lump fails whose least section has the area of a disc of `core_diameter` [m];
/// `strength`: uniaxial, of the rock [Pa]. In newton.
[[nodiscard]] double point_load_strength(double strength, double core_diameter);

/// Diameter of the disc with the area of the least of the three sections through the centroid and
/// across a principal axis of inertia [m].
[[nodiscard]] double equivalent_core_diameter(const Polyhedron& shell, const Pose& rest);

/// When blocks of a material are crushed.
struct Crushing {
  double strength = 0;  ///< uniaxial compressive strength, 0: they never are [Pa]
  double below = 0;     ///< and only blocks smaller than this share of the median volume [-]
};

/// Load that crushes each block, infinite for those that are not crushed [N]; empty where none is.
/// `crushing`: by material of `set`. The median is that of the first `n_released`: pieces of blocks
/// that are still whole come after them.
[[nodiscard]] std::vector<double> crush_loads(const BlockSet& set, const Blocks& blocks,
                                              std::span<const Crushing> crushing, int n_released);

}  // namespace talus
