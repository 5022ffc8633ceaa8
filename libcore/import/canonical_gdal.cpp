// Writes and reads the sealed GeoPackage of imported data.
#include "import/canonical_gdal.hpp"

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include "base/file_paths.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "import/vector_dataset_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/data_files_gdal.hpp"
#include "io/geopackage_gdal.hpp"

namespace talus {
namespace {

constexpr const char* frame_tag = "TALUS_FRAME";  // WKT; "none": local metres
constexpr const char* seal_tag = "TALUS_SEAL";    // map_digest()
constexpr const char* sources_table = "sources";
constexpr const char* source_field = "source";  // a row of it, from 1
constexpr std::size_t points_at_once = 1000;    // of one feature

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

std::vector<VectorFeature> features_of(const VectorShapes& shapes) {
  std::vector<VectorFeature> features;
  for (std::size_t s = 0; s < shapes.shapes.size(); ++s) {
    const std::vector<Vec3>& points = shapes.shapes[s];
    if (shapes.polygon.empty()) {
      features.emplace_back().points = points;
      continue;
    }
    if (s == 0 || shapes.polygon[s] != shapes.polygon[s - 1])
      features.emplace_back().polygons.emplace_back();
    std::vector<Vec2>& ring = features.back().polygons.back().emplace_back();
    for (const Vec3& p : points) ring.push_back(p.head<2>());
  }
  return features;
}

std::string name_of(const RequestedLayer& layer) {
  return layer.section.substr(layer.section.find('.') + 1);
}

GeometryType type_of(InputRole role) {
  return role == InputRole::site_points  ? GeometryType::point
         : role == InputRole::site_lines ? GeometryType::line
                                         : GeometryType::multi_polygon;
}

// Sections of one layer follow one another in it, each with the number of its source.
void add_shapes(std::int64_t source, const RequestedLayer& requested, const VectorShapes& shapes,
                std::vector<VectorLayer>& layers) {
  auto layer = std::find_if(layers.begin(), layers.end(), [&requested](const VectorLayer& known) {
    return known.name == requested.layer;
  });
  if (layer == layers.end()) {
    layers.emplace_back().name = requested.layer;
    layer = layers.end() - 1;
    layer->type = type_of(requested.role);
    layer->fields = {{"name", FieldType::text}, {source_field, FieldType::integer}};
    for (const std::string& field : requested.fields)
      layer->fields.push_back({field, FieldType::text});
  }
  std::vector<VectorFeature> features = features_of(shapes);
  for (std::size_t f = 0; f < features.size(); ++f) {
    features[f].values = {name_of(requested), source};
    for (std::size_t k = 0; k < requested.fields.size(); ++k) {
      const std::string& value = shapes.attributes[f][k];
      features[f].values.push_back(value.empty() ? FieldValue() : FieldValue(value));
    }
    layer->features.push_back(std::move(features[f]));
  }
}

// Where each layer comes from, a row a source.
VectorLayer sources_of(const InputsRequest& request, const Imported& inputs) {
  VectorLayer table;
  table.name = sources_table;
  table.type = GeometryType::none;
  for (const char* name : {"section", "file", "sha256", "seal"})
    table.fields.push_back({name, FieldType::text});
  std::size_t n = 0;
  for (const RequestedLayer& layer : request.layers)
    table.features.emplace_back().values =
        layer.section.empty() ? std::vector<FieldValue>{"", layer.ref.path, layer.digest, ""}
                              : std::vector<FieldValue>{layer.section, layer.file, layer.digest,
                                                        digest_of(inputs.shapes[n++])};
  return table;
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

void write_canonical(const std::string& path, const InputsRequest& request, const Imported& inputs,
                     const ImportReading& reading) {
  const ContourMap& map = inputs.map;
  std::vector<VectorLayer> layers;
  const bool has_contours = map.contours.n_lines() > 0;
  if (has_contours) layers.push_back(layer_of_lines("contours", map.contours, map.origin));
  if (map.breaklines.n_lines() > 0)
    layers.push_back(layer_of_lines("breaklines", map.breaklines, map.origin));
  if (!map.spots.empty())
    layers.push_back(layer_of_points(has_contours ? "spots" : "points", map.spots, map.origin));
  if (!map.boundary.empty()) layers.push_back(layer_of_boundary(map.boundary, map.origin));
  std::size_t n = 0;
  for (std::size_t l = 0; l < request.layers.size(); ++l)
    if (!request.layers[l].section.empty())
      add_shapes(static_cast<std::int64_t>(l) + 1, request.layers[l], inputs.shapes[n++], layers);
  layers.push_back(sources_of(request, inputs));
  layers.push_back(decisions_of(reading));
  layers.push_back(magnitudes_of(reading));
  write_geopackage(
      path, map.crs_wkt, layers,
      {{frame_tag, map.crs_wkt.empty() ? "none" : map.crs_wkt}, {seal_tag, map_digest(map)}});
}

namespace {

/// A file of talus-import: its system, and its sources in their order.
struct CanonicalFile {
  std::shared_ptr<GDALDataset> dataset;
  std::string frame, seal;
  std::vector<std::array<std::string, 4>> sources;  ///< section, file, sha256, seal
};

std::optional<CanonicalFile> open_canonical(const std::string& path) {
  if (!lower(path).ends_with(".gpkg")) return std::nullopt;
  CanonicalFile file{open_vectors(parse_source_path(path)).dataset, "", "", {}};
  const char* const frame = file.dataset->GetMetadataItem(frame_tag);
  const char* const seal = file.dataset->GetMetadataItem(seal_tag);
  OGRLayer* const sources = file.dataset->GetLayerByName(sources_table);
  if (frame == nullptr || seal == nullptr || sources == nullptr) return std::nullopt;
  file.frame = frame == std::string("none") ? "" : frame;
  file.seal = seal;
  for (const auto& row : *sources)
    file.sources.push_back({row->GetFieldAsString("section"), row->GetFieldAsString("file"),
                            row->GetFieldAsString("sha256"), row->GetFieldAsString("seal")});
  return file;
}

InputError older_than(const std::string& path, const std::string& source) {
  return {
      {path},
      "is older than " + source + ": what it was made from was another file",
      "write it anew: make, or talus-import SITE.toml -o " + command_words(path) + " --overwrite"};
}

}  // namespace

std::optional<InputsRequest> canonical_request(const std::string& path) {
  const std::optional<CanonicalFile> file = open_canonical(path);
  if (!file) return std::nullopt;
  InputsRequest request;
  request.has_frame = true;
  request.frame = file->frame;
  request.seal = file->seal;
  for (const auto& [section, source, sha256, seal] : file->sources)
    if (section.empty() && !sha256.empty() && std::filesystem::exists(file_of(source)) &&
        digest_of_data(source) != sha256)
      throw older_than(path, source);
  for (const auto& [role, name] : roles)
    if (file->dataset->GetLayerByName(name) != nullptr)
      request.layers.push_back({role, {path + "|layername=" + name, "geometry.Z", 0}});
  if (request.layers.empty()) return std::nullopt;
  return request;
}

std::optional<CanonicalLayer> canonical_layer(const std::string& path, const RequestedLayer& wanted,
                                              const std::string& crs) {
  const std::optional<CanonicalFile> file = open_canonical(path);
  if (!file)
    throw InputError({path}, "was not written by talus-import",
                     "leave --inputs out, or write it: talus-import SITE.toml -o inputs.gpkg");
  const bool is_in_crs = file->frame.empty() ? crs.empty() : same_crs(file->frame, crs);
  for (std::size_t s = 0; s < file->sources.size() && is_in_crs; ++s) {
    const auto& [section, source, sha256, seal] = file->sources[s];
    if (section != wanted.section || source != wanted.file) continue;
    if (sha256 != wanted.digest) throw older_than(path, source);
    return CanonicalLayer{path + "|layername=" + wanted.layer + "|subset=" + source_field + " = " +
                              std::to_string(s + 1),
                          seal};
  }
  return std::nullopt;
}

}  // namespace talus
