// libcore/io/topology_gdal.hpp: public
// Whether polygons may be filed: sound, large and wide enough, and none over another.
// in:    polygons of rings, the outer one first, as geopackage_gdal.hpp writes them
// out:   nothing, or an error with the place
// refs:  OGC Simple Features (validity), GEOS through OGR
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

struct TopologyRules {
  double least_area = 0;   ///< of a polygon [m2]
  double least_width = 0;  ///< twice the area over the length of its rings [m]
};

/// Throws InputError for `path`, `layer`, with map coordinates, where a polygon is not sound, is
/// smaller or narrower than the rules allow, or shares an area with another one.
void check_topology(const std::vector<std::vector<std::vector<Vec2>>>& polygons,
                    const TopologyRules& rules, const std::string& path, const std::string& layer);

}  // namespace talus
