// Reads areas, lines and points of a vector source in map coordinates.
#include "import/vectors_gdal.hpp"

#include <utility>

#include "base/sha256.hpp"
#include "import/raw_inputs_gdal.hpp"

namespace talus {

InputRole role_of(VectorKind kind) {
  if (kind == VectorKind::points) return InputRole::site_points;
  return kind == VectorKind::lines ? InputRole::site_lines : InputRole::site_areas;
}

VectorShapes take_shapes(RawLayer& layer) {
  VectorShapes found;
  static_cast<LayerReading&>(found) = layer.taken;
  found.attributes = std::move(layer.attributes);
  const Polylines& lines = layer.lines;
  for (int l = 0; l < lines.n_lines(); ++l)
    found.shapes.emplace_back(lines.points.begin() + lines.begin[l],
                              lines.points.begin() + lines.begin[l + 1]);
  found.polygon = std::move(layer.polygon);
  return found;
}

VectorShapes read_vectors(const VectorQuery& query, const std::string& crs_wkt) {
  InputsRequest request;
  request.layers = {{role_of(query.kind), {query.path, "", 0}, query.fields}};
  request.has_frame = true;
  request.frame = crs_wkt;
  RawInputs raw = read_inputs(request);
  VectorShapes found = take_shapes(raw.layers.front());
  found.doubts = std::move(raw.reading.doubts);
  return found;
}

std::string digest_of(const VectorShapes& shapes) {
  Sha256 hash;
  for (const std::vector<Vec3>& shape : shapes.shapes) {
    const std::size_t n = shape.size();
    hash.add(&n, sizeof n);
    for (const Vec3& point : shape) hash.add(point.data(), 2 * sizeof point[0]);
  }
  for (const std::vector<std::string>& values : shapes.attributes)
    for (const std::string& value : values) hash.add(value.c_str(), value.size() + 1);
  return hash.hex();
}

}  // namespace talus
