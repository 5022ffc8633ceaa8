// libcore/terrain/ground_doubts.hpp: public
// Nodes of a terrain that those beside them do not bear out: what is left of undeclared nodata,
// spikes, pits, ground that is too low for any land.
// in:    a TRN
// out:   places to look at
// method: docs/guide/limits.md, "Rasters"
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/trn.hpp"

namespace talus {

enum class GroundDoubtKind {
  below_land,  ///< below lowest_land
  level,       ///< an area of one value that stands off most of what is beside it
  rim,         ///< beside unknown ground, far off the node further in: blended with nodata
  step,        ///< far above or below a node beside it
  seam         ///< one step along a straight line of nodes: two sources meet (seams.hpp)
};

struct GroundDoubt {
  GroundDoubtKind kind = GroundDoubtKind::step;
  int row = 0, col = 0;      ///< a level area: its first node
  double expected = 0;       ///< height beside it; NaN: not known [m above the origin]
  std::int64_t n_nodes = 1;  ///< of a level area
};

/// Height between nodes side by side that ground seldom has [m]: 20 m, and 5 cells where those are
/// more.
[[nodiscard]] double doubtful_step(double cell_size);

/// A step is doubtful from impossible_step() on, at a rim and around a level area from
/// doubtful_step() on; a level area has two nodes and more. A seam is one doubt, in
/// the middle of its line. Each node once, row by row; none in most sound terrain.
[[nodiscard]] std::vector<GroundDoubt> find_ground_doubts(const Trn& trn);

}  // namespace talus
