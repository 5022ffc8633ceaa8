// libcore/dda/start_overlaps.hpp
// Blocks that overlap before anything moves, with one another or with a fence: how deep, which two,
// where; and small overlaps moved apart.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "contact/start_contacts.hpp"
#include "dda/fence.hpp"

namespace talus {

/// Overlap that rounding and stored files explain [m].
inline constexpr double overlap_tolerance = 1e-3;
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

/// How move_apart went.
struct MovedApart {
  bool done = false;  ///< no overlap above the tolerance is left
  int rounds = 0;
  double farthest = 0;  ///< way of the block that moved most [m]
};

/// Moves overlapping blocks apart along their normals, both by half of the overlap, in rounds over
/// all pairs until none overlaps by more than `tolerance` [m]. Blocks keep their shape and
/// attitude.
MovedApart move_apart(BlockSet& blocks, double tolerance);

}  // namespace talus
