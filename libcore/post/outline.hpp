// libcore/post/outline.hpp: public
// The outline of a set of cells, as polygons with holes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "record/passages.hpp"

namespace talus {

/// One polygon for each group of cells that share sides: outer ring counter-clockwise first, then
/// holes clockwise; rings are not closed by a repeated point; no point in the middle of a straight
/// side. `cells` ascending, indices of `grid`; coordinates are the grid's [m].
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> outline(
    const PassageGrid& grid, std::span<const std::uint32_t> cells);

}  // namespace talus
