// libcore/io/polygons_gdal.hpp
// Polygons of GDAL as rings of points.
#pragma once

#include <vector>

#include "base/types.hpp"

class OGRGeometry;

namespace talus {

/// Polygon, ring, points, no ring closed by a repeated point; other geometries are left out.
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> polygons_of(const OGRGeometry& geometry);

}  // namespace talus
