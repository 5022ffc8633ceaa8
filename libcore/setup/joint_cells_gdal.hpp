// libcore/setup/joint_cells_gdal.hpp: public
// Blocks that [joints.*] of a site cut in rock far from its surface: the source of single rocks
// that are drawn.
// in:    the site, a seed
// out:   whole cells of cubes of rock, each with the share of all cells that it represents
// refs:  Miles 1974; Lantuejoul 1980 (a window holds large cells less often than small ones)
#pragma once

#include <cstdint>
#include <vector>

#include "base/input_log.hpp"
#include "blocks/block_set.hpp"
#include "site/site.hpp"

namespace talus {

struct JointCells {
  std::vector<Body> cells;          ///< each about its centre of mass
  std::vector<double> share_up_to;  ///< of the cells up to each one; the last is 1   (n_cells)
};

/// Cuts 16 cubes that should hold some 500 cells and takes those that none of their sides cuts. A
/// cell of extents w is whole in a cube of side L for a share of its places, the product of 1 - w /
/// L over the axes, and counts as much more. Cubes grow up to twice while whole cells hold less
/// than a tenth of them. Throws InputError where they hold less even then: most cells are larger.
[[nodiscard]] JointCells cut_joint_cells(InputLog& log, const Site& site, std::uint64_t seed,
                                         const Where& where);

}  // namespace talus
