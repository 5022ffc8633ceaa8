// libcore/setup/start_overlaps.hpp
// Blocks that overlap before anything moves, with one another or with a fence: how deep, which two,
// where; and blocks lifted out of the ground and moved apart.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "contact/start_contacts.hpp"
#include "scene/fence.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Overlap that rounding and stored files explain [m].
inline constexpr double overlap_tolerance = 1e-3;
/// Overlap that --settle leaves [m].
inline constexpr double settled_tolerance = 1e-6;
/// Deepest overlap that is moved apart, as a share of the thinner block's thickness.
inline constexpr double most_relaxed = 0.05;

/// An overlap, and whether it may be moved apart.
struct StartOverlap {
  BlockOverlap overlap;   ///< block_b may be a panel: n_blocks + its number
  double limit = 0;       ///< most_relaxed times the thickness of the thinner block [m]
  bool is_small = false;  ///< between two blocks, and not deeper than `limit`
};

/// Overlaps by more than `tolerance` [m] among the blocks (`among_blocks`) and of blocks with the
/// panels of `fences`, the deepest first.
[[nodiscard]] std::vector<StartOverlap> start_overlaps(const BlockSet& blocks,
                                                       const std::vector<StandingFence>& fences,
                                                       bool among_blocks, double tolerance);

/// How settle went.
struct Settled {
  bool done = false;  ///< nothing above the tolerance is left
  int rounds = 0;
  double farthest = 0;  ///< path of the block that moved most [m]
};

/// Moves blocks until none is deeper than `tolerance` [m] in the ground or (`among_blocks`) in
/// another one, in rounds over all blocks and pairs. A block in the ground is lifted out of it. Of
/// two blocks that lie on each other the upper one is lifted and the lower one stays, so that a
/// lift carries what lies on it; two that are side by side move apart level, both by half. Blocks
/// that lean on one another in a circle would rise for ever: overlaps left after 60 rounds move
/// apart along the normals. Blocks keep their shape and attitude.
Settled settle(BlockSet& blocks, const Trn& trn, bool among_blocks, double tolerance);

}  // namespace talus
