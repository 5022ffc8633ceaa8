// libcore/blocks/failure_raster.hpp: public
// Meaning of the values of a failure raster: elevations of the surface, or depths of the mass.
// in:    the raster at the nodes of the terrain, the source area
// out:   a raster of elevations; refusals of one that is plainly the other
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "blocks/area.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Throws InputError where `elevation` [m, on the map] is plainly a raster of depths: inside the
/// area none is negative, half of them are below 0.3 of the lowest ground there, and the mass would
/// be deeper than half the size of the source (root of its area).
void check_is_surface(const Trn& ground, const Area& area, const std::vector<double>& elevation,
                      const Where& where);

/// From upright depths to elevations, local to the terrain, NaN where unknown; `depth` becomes
/// them. Throws InputError where a depth inside the area is negative, or where depths are plainly
/// elevations: half of them deeper than half the size of the source, and near the ground's own
/// elevations.
void lower_by_thickness(const Trn& ground, const Area& area, const Where& where,
                        std::vector<double>& depth);

}  // namespace talus
