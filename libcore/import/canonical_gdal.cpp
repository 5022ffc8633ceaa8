#include "import/canonical_gdal.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.hpp"
#include "import/import_inputs_gdal.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "import/vector_dataset_gdal.hpp"
#include "io/geopackage_gdal.hpp"

namespace talus {
namespace {

constexpr const char* frame_tag = "TALUS_FRAME";  // WKT; "none": local metres
constexpr const char* seal_tag = "TALUS_SEAL";    // map_digest()
constexpr std::size_t points_at_once = 1000;      // of one feature

constexpr std::array roles = {
    std::pair{InputRole::contours, "contours"}, std::pair{InputRole::points, "points"},
    std::pair{InputRole::breaklines, "breaklines"}, std::pair{InputRole::spots, "spots"},
    std::pair{InputRole::boundary, "boundary"}};

VectorLayer layer_of_lines(const char* name, const Polylines& lines, const Vec3& origin) {
  VectorLayer layer;
  layer.name = name;
  layer.type = GeometryType::line_z;
  layer.fields = {{source_feature_field, FieldType::integer}};
  for (int l = 0; l < lines.n_lines(); ++l) {
    VectorFeature& line = layer.features.emplace_back();
    for (int i = lines.begin[l]; i < lines.begin[l + 1]; ++i)
      line.points.push_back(lines.points[i] + origin);
    line.values = {lines.feature[l]};
  }
  return layer;
}

VectorLayer layer_of_points(const char* name, const std::vector<Vec3>& points, const Vec3& origin) {
  VectorLayer layer;
  layer.name = name;
  layer.type = GeometryType::multi_point_z;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % points_at_once == 0) layer.features.emplace_back();
    layer.features.back().points.push_back(points[i] + origin);
  }
  return layer;
}

VectorLayer layer_of_boundary(const std::vector<BoundaryRing>& rings, const Vec3& origin) {
  VectorLayer layer;
  layer.name = "boundary";
  layer.type = GeometryType::multi_polygon;
  int polygon = -1;
  for (const BoundaryRing& ring : rings) {
    if (ring.polygon != polygon) layer.features.emplace_back().polygons.emplace_back();
    polygon = ring.polygon;
    std::vector<Vec2>& points = layer.features.back().polygons.back().emplace_back();
    for (const Vec2& p : ring.points) points.push_back(p + origin.head<2>());
  }
  return layer;
}

VectorLayer decisions_of(const ImportReading& reading) {
  VectorLayer table;
  table.name = "decisions";
  table.type = GeometryType::none;
  for (const char* name : {"layer", "file", "question", "answer", "why"})
    table.fields.push_back({name, FieldType::text});
  for (const LayerReading& layer : reading.layers)
    for (const Decision& decision : layer.decisions)
      table.features.emplace_back().values = {layer.role, layer.file, decision.question,
                                              decision.answer, decision.why};
  return table;
}

VectorLayer magnitudes_of(const ImportReading& reading) {
  VectorLayer table;
  table.name = "magnitudes";
  table.type = GeometryType::none;
  table.fields = {{"layer", FieldType::text},  {"quantity", FieldType::text},
                  {"n", FieldType::integer},   {"lowest", FieldType::real},
                  {"median", FieldType::real}, {"highest", FieldType::real},
                  {"spread", FieldType::real}};
  for (const LayerReading& layer : reading.layers)
    for (const Magnitude& m : layer.magnitudes)
      table.features.emplace_back().values = {layer.role, m.quantity, m.n,     m.lowest,
                                              m.median,   m.highest,  m.spread};
  return table;
}

}  // namespace

namespace {

Magnitude magnitude_of(const std::string& quantity, std::vector<double> values) {
  const auto at = [&values](double share) {
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
  };
  Magnitude m{quantity, static_cast<std::int64_t>(values.size()), at(0), at(0.5), at(1), 0};
  m.spread = (at(0.84) - at(0.16)) / 2;
  return m;
}

void measure(const std::vector<Vec3>& points, const Vec3& origin, bool has_heights,
             LayerReading& layer) {
  const char* const names[] = {"x_m", "y_m", "z_m"};
  for (int axis = 0; axis < (has_heights ? 3 : 2) && !points.empty(); ++axis) {
    std::vector<double> values;
    for (const Vec3& point : points) values.push_back(point[axis] + origin[axis]);
    layer.magnitudes.push_back(magnitude_of(names[axis], std::move(values)));
  }
}

}  // namespace

void measure(const ContourMap& map, ImportReading& reading) {
  for (LayerReading& layer : reading.layers) {
    if (layer.role == "contours") measure(map.contours.points, map.origin, true, layer);
    if (layer.role == "breaklines") measure(map.breaklines.points, map.origin, true, layer);
    if (layer.role == "spots" || layer.role == "points")
      measure(map.spots, map.origin, true, layer);
    std::vector<Vec3> corners;
    if (layer.role == "boundary")
      for (const BoundaryRing& ring : map.boundary)
        for (const Vec2& p : ring.points) corners.emplace_back(p.x(), p.y(), 0);
    measure(corners, map.origin, false, layer);
  }
}

void write_canonical(const std::string& path, const ContourMap& map, const ImportReading& reading) {
  std::vector<VectorLayer> layers;
  const bool has_contours = map.contours.n_lines() > 0;
  if (has_contours) layers.push_back(layer_of_lines("contours", map.contours, map.origin));
  if (map.breaklines.n_lines() > 0)
    layers.push_back(layer_of_lines("breaklines", map.breaklines, map.origin));
  if (!map.spots.empty())
    layers.push_back(layer_of_points(has_contours ? "spots" : "points", map.spots, map.origin));
  if (!map.boundary.empty()) layers.push_back(layer_of_boundary(map.boundary, map.origin));
  layers.push_back(decisions_of(reading));
  layers.push_back(magnitudes_of(reading));
  write_geopackage(
      path, map.crs_wkt, layers,
      {{frame_tag, map.crs_wkt.empty() ? "none" : map.crs_wkt}, {seal_tag, map_digest(map)}});
}

std::optional<InputsRequest> canonical_request(const std::string& path) {
  if (!lower(path).ends_with(".gpkg")) return std::nullopt;
  const VectorDataset opened = open_vectors(parse_source_path(path));
  const char* const frame = opened.dataset->GetMetadataItem(frame_tag);
  const char* const seal = opened.dataset->GetMetadataItem(seal_tag);
  if (frame == nullptr || seal == nullptr) return std::nullopt;
  InputsRequest request;
  request.has_frame = true;
  request.frame = frame == std::string("none") ? "" : frame;
  request.seal = seal;
  for (const auto& [role, name] : roles)
    if (opened.dataset->GetLayerByName(name) != nullptr)
      request.layers.push_back({role, {path + "|layername=" + name, "geometry.Z", 0}});
  return request;
}

}  // namespace talus
