// libcore/io/union_gdal.hpp: public
// Pieces of an area, put together.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

/// The union of simple rings that meet edge to edge up to `tolerance` [m], as polygons of rings,
/// the outer one first, none closed by a repeated point. Corners within `tolerance` of a straight
/// side are left out, and so are rings that are no wider than it.
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> union_of(
    const std::vector<std::vector<Vec2>>& pieces, double tolerance);

}  // namespace talus
