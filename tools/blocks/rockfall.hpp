// tools/blocks/rockfall.hpp
// The [rockfall.*] sections of the site file: where rocks are released, which ones, and how often.
#pragma once

#include "tools/blocks/bodies.hpp"

namespace talus {

/// Adds the rocks of all [rockfall.*] sections to `set`. Throws InputError.
void add_rocks(Tool& tool, const Site& site, const Trn& ground, BlockSet& set);

}  // namespace talus
