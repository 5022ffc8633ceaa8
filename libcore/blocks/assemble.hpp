// libcore/blocks/assemble.hpp: public
// From the cells of a cut mass to blocks: cells that no joint parts are one block, slivers go to a
// neighbour, and each block becomes convex or keeps its exact shape.
// in:    cell complex, joints, bed
// out:   block set with first contact pairs, and a balance of the volume
#pragma once

#include <string>
#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/cut.hpp"

namespace talus {

struct AssembleOptions {
  bool exact = false;             ///< keep non-convex blocks as unions of convex parts
  double min_volume = 0;          ///< slivers: less volume [m3],
  double min_thickness = 0;       ///< smaller smallest extent [m],
  double max_aspect = 0;          ///< or a larger ratio of largest to smallest extent; 0 = no limit
  double max_convex_loss = 0.05;  ///< blocks that would lose a larger share become several convex
                                  ///< parts, or stay exact when four do not help either
  double min_edge = -1;  ///< shorter edges of convex parts are removed [m]; < 0: 1e-3 of the cube
                         ///< root of the block's volume
  int material = 0;
};

/// Balance of the mass.
struct AssembleReport {
  int n_cells = 0;            ///< convex cells after cutting
  int n_pieces = 0;           ///< bodies of rock between joints, before slivers were merged
  int n_merged = 0;           ///< slivers given to a neighbour
  double merged_volume = 0;   ///< of them [m3]
  int n_dropped = 0;          ///< slivers without a neighbour, left out
  double dropped_volume = 0;  ///< of them [m3]
  int n_rings_parted = 0;     ///< ring-shaped blocks cut open, so that each is like a ball
  int n_divided = 0;          ///< blocks made of several convex parts: one would lose too much, or
                              ///< reach out of the source
  int n_kept_exact = 0;       ///< blocks that would have lost too much by being made convex
  int n_below_limits = 0;     ///< blocks that are slivers as they now are
  int n_short_edged = 0;      ///< blocks with edges below the limit for convex parts
  double cut_volume = 0;      ///< of all cells [m3]
  double block_volume = 0;    ///< of all blocks [m3]
  double gained = 0, lost = 0;       ///< by being made convex, summed over the blocks [m3]
  std::vector<double> exact_volume;  ///< of each block as cut (n_blocks) [m3]
};

/// Appends the blocks to `set`, in the order of their joint cells. Joint set names must be set.
[[nodiscard]] AssembleReport assemble_blocks(const CellComplex& complex,
                                             const std::vector<Joint>& joints, const Trn& bed,
                                             const AssembleOptions& options, BlockSet& set,
                                             const ProgressFunction& progress = {});

}  // namespace talus
