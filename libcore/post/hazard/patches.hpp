// libcore/post/hazard/patches.hpp: public
// Patches of cells that are too small to be filed are joined to their neighbours.
// in:    a value for each cell of a grid: 0 nothing, a higher one is worse
// out:   values whose patches, and holes, all have the least number of cells
#pragma once

#include <cstdint>
#include <vector>

namespace talus {

/// Changes by join_small_patches(), in patches and cells.
struct PatchRepair {
  int n_joined = 0, n_left_out = 0;
  std::int64_t cells_raised = 0, cells_lowered = 0;
  std::vector<std::uint32_t> left_out;  ///< cells, ascending
};

/// A patch is a set of cells of one value that share sides. One of fewer than `least` cells takes
/// the value of the neighbour with which it shares the longest border, of equal ones the higher;
/// a hole of nothing too. One with nothing around it is left out: it becomes 0. The smallest patch
/// goes first, of equal ones the first by its cells. `n_cols`: of a row of `values`.
[[nodiscard]] PatchRepair join_small_patches(std::vector<int>& values, int n_cols,
                                             std::int64_t least);

}  // namespace talus
