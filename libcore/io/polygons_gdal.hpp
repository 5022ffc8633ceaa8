// libcore/io/polygons_gdal.hpp: public
// Areas that are put together, or lie about a line: polygons of rings of points, the outer ring
// first, none closed by a repeated point.
#pragma once

#include <vector>

#include "base/types.hpp"

class OGRGeometry;
class OGRPolygon;

namespace talus {

/// Polygon, ring, points; other geometries are left out.
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> polygons_of(const OGRGeometry& geometry);

[[nodiscard]] OGRPolygon polygon_of(const std::vector<Vec2>& ring);
[[nodiscard]] OGRPolygon polygon_of(const std::vector<std::vector<Vec2>>& rings);

/// The union of simple rings that meet edge to edge up to `tolerance` [m]. Corners within
/// `tolerance` of a straight side are left out, and so are rings as narrow as it.
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> union_of(
    const std::vector<std::vector<Vec2>>& pieces, double tolerance);

/// The area within `radius` > 0 of a line, or of a single point; circles by 8 sides a quarter.
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> buffer_of(const std::vector<Vec2>& line,
                                                                    double radius);

/// The rim of the footprints of blocks together, which may overlap and lie up to `gap` apart; rings
/// without the last point. [m]
[[nodiscard]] std::vector<std::vector<Vec2>> rim_of(
    const std::vector<std::vector<Vec2>>& footprints, double gap = 0.2);

}  // namespace talus
