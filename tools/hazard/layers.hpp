// tools/hazard/layers.hpp
// Hazard classes as polygons.
#pragma once

#include <string>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "post/hazard/hazard_maps.hpp"

namespace talus {

/// Layers uncertain (hatched), classes (outlines of cells) and classes_smoothed.
[[nodiscard]] std::vector<VectorLayer> hazard_polygons(const MapLayer& classes,
                                                       const MapLayer& certainty,
                                                       const PassageGrid& grid, const Vec3& origin,
                                                       const Recipe& recipe,
                                                       const std::vector<std::string>& notes);

}  // namespace talus
