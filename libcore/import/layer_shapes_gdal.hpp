// libcore/import/layer_shapes_gdal.hpp
// Which geometries are lines, points or areas.
#pragma once

#include <string>

class OGRGeometry;
class OGRLineString;

namespace talus {

/// A face is a polygon with heights, or a surface of them (3DFACE, meshes).
enum class LayerShape { line, point, polygon, face };

/// "line", "lines"
[[nodiscard]] const char* singular(LayerShape shape);
[[nodiscard]] std::string plural(LayerShape shape);

[[nodiscard]] bool is_face(const OGRGeometry& geometry);

/// Whether the type (an OGRwkbGeometryType) is the shape, or several of it; curved or not.
[[nodiscard]] bool fits(int ogr_type, LayerShape shape);

/// Ends nearer than a millionth of the line's extent are one point: coordinates are rounded.
[[nodiscard]] bool is_closed(const OGRLineString& line);

}  // namespace talus
