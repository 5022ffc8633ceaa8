// libcore/setup/start_depth.hpp
// Depth of blocks in the ground before anything moves, and moving them as a set holds them.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Depth of each block below the ground: how far it has to be lifted until no point of it lies
/// below. Exact for convex parts on known ground: the largest overlap along the vertical is at
/// a vertex, at a terrain node, or where an edge crosses one of the terrain's. <= 0: above [m];
/// -infinity where no ground is known below.                                       (n_blocks)
[[nodiscard]] std::vector<double> depths_below_ground(const Trn& trn, const BlockSet& blocks);

/// Expresses all places of the set relative to another local zero, in map coordinates [m].
void move_to_origin(BlockSet& blocks, const Vec3& origin);

/// Moves block b by the displacement `way` [m], with all that the set holds of it.
void move_block(BlockSet& blocks, int b, const Vec3& way);

}  // namespace talus
