// tools/hazard/layers.hpp
// Hazard classes as polygons.
#pragma once

#include <string>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "post/hazard/hazard_maps.hpp"

namespace talus {

/// Polygon, ring, points of a set of cells, in map coordinates.
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> polygons_on_map(
    const PassageGrid& grid, const std::vector<std::uint32_t>& cells, const Vec3& origin);

/// Layers uncertain (hatched), classes (outlines of cells) and classes_smoothed.
[[nodiscard]] std::vector<VectorLayer> hazard_polygons(const MapLayer& classes,
                                                       const MapLayer& certainty,
                                                       const PassageGrid& grid, const Vec3& origin,
                                                       const Recipe& recipe,
                                                       const std::vector<std::string>& notes);

}  // namespace talus
