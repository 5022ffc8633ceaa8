// The part of import/raw_inputs_gdal.hpp that opens the layers of a request and reads their parts.
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/file_paths.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "io/areas_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/raster_commands.hpp"

namespace talus {
namespace {

// Laser scans take a library that not every system has; text takes none.
void refuse_laser_scan(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension != ".las" && extension != ".laz" && extension != ".e57") return;
  throw InputError({path}, "is a laser scan, which is not read as it is",
                   ground_points_command(path));
}

std::string name_of(const RequestedLayer& layer) {
  if (layer.role == InputRole::points) return "points";
  if (layer.role == InputRole::reference) return "reference_points";
  return layer.section.empty() ? role_of(layer.role).input : layer.section;
}

void append_vertex(const Vec3& point, const OGRFeature& feature, RawLayer& layer) {
  if (!std::isfinite(point.x()) || !std::isfinite(point.y()))
    check_finite(point, where_of_feature(layer.source, feature));
  layer.lines.points.push_back(point);
}

void end_line(bool has_z, const OGRFeature& feature, RawLayer& layer) {
  Polylines& lines = layer.lines;
  const auto first = lines.points.begin() + lines.begin.back();
  const bool has_number =
      std::all_of(first, lines.points.end(), [](const Vec3& p) { return std::isfinite(p.z()); });
  layer.has_z = layer.has_z && has_z;
  layer.n_flat += has_z ? 0 : 1;
  layer.n_no_number += has_z && !has_number ? 1 : 0;
  lines.begin.push_back(static_cast<int>(lines.points.size()));
  const int id = feature.GetFieldIndex(source_feature_field);
  lines.feature.push_back(id < 0 ? feature.GetFID() : feature.GetFieldAsInteger64(id));
}

double no_height(const RawLayer& layer) { return layer.has_heights() ? 0 : NAN; }

void append_line(const OGRSimpleCurve& curve, bool is_ring, const OGRFeature& feature,
                 RawLayer& layer) {
  const bool has_z = curve.Is3D() != 0;
  const int n = curve.getNumPoints();
  const bool repeats_first =
      is_ring && n > 1 && curve.getX(0) == curve.getX(n - 1) && curve.getY(0) == curve.getY(n - 1);
  for (int i = 0; i < (repeats_first ? n - 1 : n); ++i)
    append_vertex({curve.getX(i), curve.getY(i), has_z ? curve.getZ(i) : no_height(layer)}, feature,
                  layer);
  end_line(has_z, feature, layer);
}

void append_point(const OGRPoint& point, const OGRFeature& feature, RawLayer& layer) {
  const bool has_z = point.Is3D() != 0;
  append_vertex({point.getX(), point.getY(), has_z ? point.getZ() : no_height(layer)}, feature,
                layer);
  end_line(has_z, feature, layer);
}

void append_rings(const OGRPolygon& polygon, const OGRFeature& feature, RawLayer& layer) {
  const int number = layer.polygon.empty() ? 0 : layer.polygon.back() + 1;
  for (const OGRLinearRing* ring : polygon) {
    append_line(*ring, true, feature, layer);
    layer.polygon.push_back(number);
  }
}

// The attributes asked for, as text.
std::vector<std::string> attributes_of(const OGRFeature& feature,
                                       const std::vector<std::string>& fields) {
  std::vector<std::string> values;
  for (const std::string& name : fields) {
    const int index = feature.GetFieldIndex(name.c_str());
    values.emplace_back(index >= 0 && feature.IsFieldSetAndNotNull(index) != 0
                            ? feature.GetFieldAsString(index)
                            : "");
  }
  return values;
}

// Areas that GeoJSON cuts at 180 degrees meet there.
void bring_to_one_side(const std::string& crs, std::vector<std::unique_ptr<OGRPolygon>>& polygons) {
  std::vector<Vec3> points;
  for (const auto& polygon : polygons)
    for (const OGRLinearRing* ring : *polygon)
      for (int k = 0; k < ring->getNumPoints(); ++k)
        points.emplace_back(ring->getX(k), ring->getY(k), 0);
  if (points.empty() || is_beyond_degrees(crs, points)) return;
  const auto near = on_one_side(crs);
  const double first = points.front().x();
  for (const auto& polygon : polygons)
    for (OGRLinearRing* ring : *polygon)
      for (int k = 0; k < ring->getNumPoints(); ++k)
        ring->setPoint(k, near(ring->getX(k), first), ring->getY(k));
}

// Areas of a site are united where they meet; their rings belong to no single feature.
Uniting read_areas(RawLayer& layer) {
  std::vector<std::unique_ptr<OGRPolygon>> polygons;
  for_each_part(layer.source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    const Where where = where_of_feature(layer.source, feature);
    for (const OGRLinearRing* ring : *part.toPolygon())
      for (int k = 0; k < ring->getNumPoints(); ++k)
        check_finite({ring->getX(k), ring->getY(k), 0}, where);
    check_polygon(*part.toPolygon(), where);
    polygons.emplace_back(part.toPolygon()->clone());
  });
  bring_to_one_side(layer.own_crs, polygons);
  const Uniting uniting = unite_polygons(polygons, where_of_layer(layer.source));
  const OGRFeature none(layer.source.layer->GetLayerDefn());
  for (const auto& polygon : polygons) append_rings(*polygon, none, layer);
  return uniting;
}

std::string label_of(const OpenLayer& source, const OGRFeature& feature) {
  OGRLayer& layer = *source.layers[source.current];
  const std::string& by_user = source.ref.elevation_field;
  const std::string name = by_user.empty() ? "Text" : by_user;
  const int index = find_index(layer, name);
  if (index >= 0) return feature.GetFieldAsString(index);
  throw InputError(where_of_layer(source),
                   "there is no field " + name + "; the fields are: " + list_of_fields(layer),
                   "name the field with the labels' text: --elevation-field labels=FIELD");
}

Uniting read_parts(const RequestedLayer& requested, RawLayer& layer) {
  if (requested.role == InputRole::site_areas) return read_areas(layer);
  for_each_part(layer.source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    const OGRwkbGeometryType type = wkbFlatten(part.getGeometryType());
    if (type == wkbPoint)
      append_point(*part.toPoint(), feature, layer);
    else if (type == wkbPolygon)
      append_rings(*part.toPolygon(), feature, layer);
    else
      append_line(*part.toLineString(), false, feature, layer);
    if (layer.field) layer.field->add(layer.source, feature);
    if (requested.role == InputRole::site_points)
      layer.attributes.push_back(attributes_of(feature, requested.fields));
    if (requested.role == InputRole::labels)
      layer.attributes.push_back({label_of(layer.source, feature)});
  });
  return {};
}

// Points of the site file.
RawLayer take_written(const RequestedLayer& requested) {
  RawLayer layer;
  layer.role = requested.role;
  layer.written = &requested;
  layer.source.ref.path = requested.where.file;
  layer.source.role = role_of(requested.role);
  layer.own_crs = requested.crs;
  layer.lines.points = requested.points;
  const int n = static_cast<int>(requested.points.size());
  for (int end = requested.role == InputRole::site_points ? 1 : n; end <= n; ++end) {
    layer.lines.begin.push_back(end);
    layer.lines.feature.push_back(0);
  }
  if (requested.role == InputRole::site_areas) layer.polygon = {0};
  layer.taken.role = requested.section;
  const Where& where = requested.where;
  layer.taken.file = where.file.empty() ? where.text() : where.file;
  layer.taken.layer = requested.section;
  layer.taken.noun = singular(layer.source.role.shape);
  layer.taken.n_parts = layer.lines.n_lines();
  layer.decide("layer", layer.taken.layer, "written in the site file");
  return layer;
}

RawLayer open_raw(const RequestedLayer& requested) {
  if (!requested.points.empty()) return take_written(requested);
  refuse_laser_scan(requested.ref.path);
  RawLayer layer;
  layer.role = requested.role;
  layer.source = open_layer(requested.ref, role_of(requested.role));
  layer.own_crs = wkt_of(layer.source.layer->GetSpatialRef());
  if (layer.has_heights()) layer.field = HeightField::find(layer.source);
  const Uniting uniting = read_parts(requested, layer);
  layer.taken = reading_of(layer.source);
  layer.taken.n_united = uniting.n_united;
  layer.taken.n_made = uniting.n_made;
  layer.taken.role = name_of(requested);
  const SourcePath named = parse_source_path(requested.ref.path);
  layer.decide("layer", layer.taken.layer,
               named.layer.empty() && named.layer_id.empty()
                   ? "the only one with " + plural(layer.source.role.shape)
                   : "named");
  return layer;
}

}  // namespace

Where RawLayer::where() const {
  if (written != nullptr) return written->where;
  return is_of_site() ? where_of_layer(source) : Where{source.ref.path};
}

RawLayer* RawInputs::find(InputRole role) {
  for (RawLayer& layer : layers)
    if (layer.role == role) return &layer;
  return nullptr;
}

RawInputs open_all(const InputsRequest& request) {
  RawInputs raw{request, {}, request.frame, {}};
  for (const RequestedLayer& requested : request.layers) raw.layers.push_back(open_raw(requested));
  return raw;
}

}  // namespace talus
