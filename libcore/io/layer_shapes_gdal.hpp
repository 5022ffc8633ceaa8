// Which geometries are lines, points or areas.
#pragma once

#include <ogr_core.h>

#include "io/contour_layer_gdal.hpp"

class OGRLineString;

namespace talus {

/// "lines", "points", "polygons"
[[nodiscard]] const char* plural(LayerShape shape);

/// Whether the type is the shape, or several of it; curved or not.
[[nodiscard]] bool fits(OGRwkbGeometryType type, LayerShape shape);

/// Ends nearer than a millionth of the line's extent are one point: coordinates are rounded.
[[nodiscard]] bool is_closed(const OGRLineString& line);

}  // namespace talus
