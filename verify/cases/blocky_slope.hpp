// verify/cases/blocky_slope.hpp
// The slope as the original method models it: fixed polyhedral blocks, found by the general search
// of block pairs. For comparison with the TRN, which finds the same contacts by the cell below.
// paper: Zhang et al. 2018, Fig. 1 and Sect. 6
#pragma once

#include "scene/scene.hpp"

namespace talus {

/// Adds one prism for each known triangle of the scene's TRN, its top the triangle, and turns
/// contacts with the TRN off. Prisms reach `depth` [m] down, > 0; they have the friction and
/// restitution of their cell. Call it when the blocks are there.
void add_blocky_slope(Scene& scene, double depth);

/// A depth that no block reaches through in a step: the larger of two cells and the largest block's
/// diameter [m].
[[nodiscard]] double blocky_depth(const Scene& scene);

}  // namespace talus
