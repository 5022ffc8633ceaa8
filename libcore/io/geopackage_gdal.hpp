// libcore/io/geopackage_gdal.hpp: public
// Features with attributes as layers of a GeoPackage, each with the style that QGIS opens it with.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/fields.hpp"
#include "base/types.hpp"

namespace talus {

struct VectorField {
  std::string name;  ///< unit in the name
  FieldType type = FieldType::real;
  std::string title = {};  ///< in words, with the unit
};
template <class Row>
[[nodiscard]] std::vector<VectorField> vector_fields(const std::vector<Field<Row>>& fields) {
  std::vector<VectorField> out;
  for (const Field<Row>& field : fields)
    out.push_back({field.name, field.type, title_of(field.title, field.unit)});
  return out;
}

enum class GeometryType {
  point,
  point_z,
  multi_point_z,
  line,
  line_z,
  line_zm,
  multi_polygon,
  polygon,
  none
};

/// Points of one feature: a point, several, a line, or the rings of polygons; map coordinates [m].
/// None: it is written without a place.
struct VectorFeature {
  std::vector<Vec3> points;     ///< points or a line
  std::vector<double> measure;  ///< M of each point of a line; may be empty         (n_points)
  std::vector<std::vector<std::vector<Vec2>>>
      polygons;                    ///< polygon, ring, points; first ring outer
  std::vector<FieldValue> values;  ///<                        (n_fields)
};

struct VectorLayer {
  std::string name, description;
  GeometryType type = GeometryType::point_z;
  std::vector<VectorField> fields;
  std::vector<VectorFeature> features;
  std::string qml;                ///< default style; empty: none
  std::string geometry = "geom";  ///< name of its column
};

/// Writes a new GeoPackage, byte by byte the same for the same layers. `tags` become metadata of
/// the file. NaN is written as NULL. Throws InputError when it cannot be written whole.
void write_geopackage(const std::string& path, const std::string& crs_wkt,
                      const std::vector<VectorLayer>& layers,
                      const std::vector<std::pair<std::string, std::string>>& tags = {});

}  // namespace talus
