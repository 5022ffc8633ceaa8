// libcore/io/layer_shapes_gdal.hpp
// Which geometries are lines, points or areas.
#pragma once

class OGRLineString;

namespace talus {

enum class LayerShape { line, point, polygon };

/// "lines", "points", "polygons"
[[nodiscard]] const char* plural(LayerShape shape);

/// Whether the type (an OGRwkbGeometryType) is the shape, or several of it; curved or not.
[[nodiscard]] bool fits(int ogr_type, LayerShape shape);

/// Ends nearer than a millionth of the line's extent are one point: coordinates are rounded.
[[nodiscard]] bool is_closed(const OGRLineString& line);

}  // namespace talus
