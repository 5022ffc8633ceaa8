// libcore/io/footprints_gdal.hpp: public
// Plan views of blocks as layers of a GeoPackage.
#pragma once

#include <vector>

#include "blocks/block_set.hpp"
#include "io/geopackage_gdal.hpp"

namespace talus {

/// Layer `blocks`: the plan outline (convex hull) of each block with block_id, volume_m3, material,
/// top and bottom elevation, extents; and layer `source_area` with the rings given in map
/// coordinates, when there are any.
[[nodiscard]] std::vector<VectorLayer> footprint_layers(
    const BlockSet& set, const std::vector<std::vector<Vec2>>& source_rings);

}  // namespace talus
