// libcore/io/footprints_gdal.hpp: public
// Plan views of blocks as a GeoPackage for QGIS, with a default style.
#pragma once

#include <map>
#include <string>

#include "blocks/block_set.hpp"

namespace talus {

/// Writes layer `blocks`: the plan outline (convex hull) of each block with block_id, volume_m3,
/// material, top and bottom elevation, extents; and layer `source_area` with the rings given in map
/// coordinates, when there are any. The same set gives the same bytes. Throws InputError.
void write_footprints(const std::string& path, const BlockSet& set,
                      const std::vector<std::vector<Vec2>>& source_rings,
                      const std::map<std::string, std::string>& tags = {});

}  // namespace talus
