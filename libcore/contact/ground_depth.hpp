// libcore/contact/ground_depth.hpp: public
// How deep a body and the ground are in each other, as bodies: no contact is asked.
// in:    a placed body, the terrain
// out:   the least motion, at least, that frees the body's deepest vertex and the deepest part of
//        the ground in it
#pragma once

#include <vector>

#include "contact/hulls.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Arrays that depth_in_ground fills anew; kept to spare allocation.
struct GroundDepthScratch {
  std::vector<Vec3> polygon, clipped;
};

/// The larger of two depths [m]: the distance from the ground's surface of the vertex of `body`
/// that is farthest below it, and the distance from the body's surface of the point of the ground's
/// that is farthest inside a part of the body. 0: they do not overlap, or the ground there is not
/// known.
[[nodiscard]] double depth_in_ground(const Trn& trn, const Hulls& hulls, const PlacedHulls& placed,
                                     int body, GroundDepthScratch& scratch);

}  // namespace talus
