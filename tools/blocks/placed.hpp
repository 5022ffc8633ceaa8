// tools/blocks/placed.hpp
// The [blocks.*] sections of the site file: bodies from meshes and shapes that rest on one another,
// put where they start.
#pragma once

#include "tools/blocks/bodies.hpp"

namespace talus {

/// Adds the bodies of all [blocks.*] sections to `set`. Throws InputError.
void add_placed_blocks(Tool& tool, const Site& site, const Trn& ground, BlockSet& set);

}  // namespace talus
