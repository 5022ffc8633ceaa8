// tools/blocks/placed.hpp
// The [blocks.*] sections of the site file: bodies from meshes and shapes, put where they start.
#pragma once

#include "blocks/block_set.hpp"
#include "blocks/source.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// What the sections need from the rest of the tool.
struct PlacedContext {
  Tool& tool;
  const Site& site;
  const Trn& ground;
  const Area* source_area = nullptr;  ///< for release_grid; null when the site has no source
};

/// Adds the bodies of all [blocks.*] sections to `set`. Throws InputError.
void add_placed_blocks(const PlacedContext& context, BlockSet& set);

}  // namespace talus
