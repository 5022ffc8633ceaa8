#include "io/contours_gdal.hpp"

#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

// Names under which elevations are found, the most telling first; compared in lower case.
constexpr std::array elevation_names = {
    "elev",         "elevation", "height",     "contour",     "z",        "prop_value", "altitude",
    "alt",          "hoehe",     "höhe",       "kote",        "cota",     "quota",      "elev_m",
    "height_m",     "z_value",   "contour_m",  "elevation_m", "isohypse", "hgt",        "elev_ft",
    "elevation_ft", "height_ft", "contour_ft", "elev_feet"};

enum class Shape { line, point, polygon };

const char* plural(Shape shape) {
  return shape == Shape::line ? "lines" : shape == Shape::point ? "points" : "polygons";
}

// --- layers --------------------------------------------------------------------------------------

struct Source {
  GDALDatasetUniquePtr dataset;
  OGRLayer* layer = nullptr;
  bool is_drawing = false;  // DXF: one layer holds all sorts of things
  std::string name;         // of the layer, for messages
};

GDALDatasetUniquePtr open_vectors(const std::string& path) {
  register_gdal_drivers();
  const GdalErrors errors;
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR));
  if (dataset) return dataset;
  throw InputError(
      {path},
      "cannot be opened as vectors" + (errors.failed() ? ": " + errors.failure() : std::string()),
      "ogrinfo " + path + " shows what GDAL makes of it");
}

bool fits(OGRwkbGeometryType type, Shape shape) {
  const OGRwkbGeometryType flat = OGR_GT_GetLinear(wkbFlatten(type));
  switch (shape) {
    case Shape::line:
      return flat == wkbLineString || flat == wkbMultiLineString;
    case Shape::point:
      return flat == wkbPoint || flat == wkbMultiPoint;
    default:
      return flat == wkbPolygon || flat == wkbMultiPolygon;
  }
}

// Whether the layer is declared, or turns out at its first geometry, to hold the shape.
bool holds(OGRLayer& layer, Shape shape) {
  if (layer.GetGeomType() == wkbNone) return false;
  if (wkbFlatten(layer.GetGeomType()) != wkbUnknown) return fits(layer.GetGeomType(), shape);
  layer.ResetReading();
  for (const auto& feature : layer) {
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (geometry == nullptr) continue;
    layer.ResetReading();
    return fits(geometry->getGeometryType(), shape);
  }
  return false;
}

std::string list_of_layers(GDALDataset& dataset) {
  std::string names;
  for (OGRLayer* layer : dataset.GetLayers())
    names += (names.empty() ? "" : ", ") + std::string(layer->GetName());
  return names.empty() ? "none" : names;
}

std::string quoted(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '\'' ? "''" : std::string(1, c);
  return "'" + escaped + "'";
}

void choose_by_name(const LayerChoice& choice, Source& source) {
  source.layer = source.dataset->GetLayerByName(choice.layer.c_str());
  source.name = choice.layer;
  if (source.layer != nullptr) return;
  if (source.is_drawing) {
    source.layer = source.dataset->GetLayer(0);
    source.layer->SetAttributeFilter(("Layer = " + quoted(choice.layer)).c_str());
    if (source.layer->GetFeatureCount() > 0) return;
    throw InputError({choice.path}, "the drawing has nothing in a layer \"" + choice.layer + "\"",
                     "ogrinfo -al " + choice.path + " shows the layers as attribute Layer");
  }
  throw InputError({choice.path}, "there is no layer \"" + choice.layer +
                                      "\"; there are: " + list_of_layers(*source.dataset));
}

void choose_by_shape(const LayerChoice& choice, Shape shape, const std::string& option,
                     Source& source) {
  std::vector<OGRLayer*> fitting;
  for (OGRLayer* layer : source.dataset->GetLayers())
    if (holds(*layer, shape)) fitting.push_back(layer);
  if (fitting.empty() && source.dataset->GetLayerCount() == 1)
    fitting.push_back(source.dataset->GetLayer(0));  // its features say what is wrong
  if (fitting.size() != 1)
    throw InputError({choice.path},
                     std::to_string(fitting.size()) + " layers hold " + plural(shape) +
                         ", expected one; the layers are: " + list_of_layers(*source.dataset),
                     "choose with " + option);
  source.layer = fitting.front();
  source.name = source.layer->GetName();
}

Source open_layer(const LayerChoice& choice, Shape shape, const std::string& option) {
  Source source;
  source.dataset = open_vectors(choice.path);
  source.is_drawing = std::string(source.dataset->GetDriverName()) == "DXF";
  if (choice.layer.empty())
    choose_by_shape(choice, shape, option, source);
  else
    choose_by_name(choice, source);
  return source;
}

// --- features ------------------------------------------------------------------------------------

Where where_of(const LayerChoice& choice, const Source& source, const OGRFeature& feature) {
  return {choice.path, 0, "layer " + source.name + ", feature " + std::to_string(feature.GetFID())};
}

// Calls visit(geometry, feature) for every simple part of the wanted shape. Counts features without
// geometry and refuses them at the end: a truncated file reads without complaint. Other shapes are
// refused too, but in a drawing, where they are counted into `n_ignored`.
void for_each_part(const LayerChoice& choice, Source& source, Shape shape, std::int64_t& n_ignored,
                   std::int64_t& n_features,
                   const std::function<void(const OGRGeometry&, const OGRFeature&)>& visit) {
  const GdalErrors errors;
  std::int64_t n_null = 0;
  n_features = 0;
  const std::function<void(const OGRGeometry&, const OGRFeature&)> descend =
      [&](const OGRGeometry& geometry, const OGRFeature& feature) {
        const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
        if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
          for (const OGRGeometry* part : *geometry.toGeometryCollection()) descend(*part, feature);
        } else if (fits(type, shape)) {
          visit(geometry, feature);
        } else if (source.is_drawing) {
          ++n_ignored;
        } else {
          throw InputError(where_of(choice, source, feature), std::string("the geometry is ") +
                                                                  geometry.getGeometryName() +
                                                                  ", expected " + plural(shape));
        }
      };
  source.layer->ResetReading();
  for (const auto& feature : *source.layer) {
    ++n_features;
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (geometry == nullptr || geometry->IsEmpty()) {
      ++n_null;
      continue;
    }
    const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
    descend(*linear, *feature);
  }
  const Where where{choice.path, 0, "layer " + source.name};
  if (n_features == 0)
    throw InputError(where, "the layer is empty, expected " + std::string(plural(shape)));
  if (n_null > 0)
    throw InputError(where,
                     std::to_string(n_null) + " of " + std::to_string(n_features) +
                         " features have no geometry, expected none: is the file truncated?",
                     "copy the file anew; features that are meant to be empty must be deleted");
  if (errors.failed()) throw InputError(where, "reading failed: " + errors.failure());
}

void check_finite(const Vec3& point, const Where& where) {
  if (point.allFinite()) return;
  throw InputError(where, "a coordinate is not finite (x " + text(point.x()) + ", y " +
                              text(point.y()) + ", z " + text(point.z()) + ")");
}

// --- elevation -----------------------------------------------------------------------------------

// Where the elevation of a feature stands: its Z, or a field.
struct ElevationField {
  int index = -1;  // -1: Z
  std::string name;
};

std::string list_of_fields(const OGRFeatureDefn& definition) {
  std::string names;
  for (int i = 0; i < definition.GetFieldCount(); ++i)
    names += (i == 0 ? "" : ", ") + std::string(definition.GetFieldDefn(i)->GetNameRef());
  return names.empty() ? "none" : names;
}

ElevationField field_by_user(const LayerChoice& choice, const Source& source,
                             const std::string& name) {
  OGRFeatureDefn& definition = *source.layer->GetLayerDefn();
  const int index = definition.GetFieldIndex(name.c_str());
  if (index >= 0) return {index, definition.GetFieldDefn(index)->GetNameRef()};
  if (lower(name) == "z") return {-1, "Z"};
  throw InputError(
      {choice.path, 0, "layer " + source.name},
      "there is no field \"" + name + "\"; the fields are: " + list_of_fields(definition),
      "choose one with --elevation-field, or Z for the geometries' own Z");
}

std::optional<ElevationField> field_by_name(const Source& source) {
  OGRFeatureDefn& definition = *source.layer->GetLayerDefn();
  for (const char* name : elevation_names)
    for (int i = 0; i < definition.GetFieldCount(); ++i)
      if (lower(definition.GetFieldDefn(i)->GetNameRef()) == name)
        return ElevationField{i, definition.GetFieldDefn(i)->GetNameRef()};
  return std::nullopt;
}

double field_value(const OGRFeature& feature, const ElevationField& field, const Where& where) {
  if (!feature.IsFieldSetAndNotNull(field.index))
    throw InputError(where, "the field " + field.name + " is empty, expected an elevation");
  const OGRFieldType type = feature.GetFieldDefnRef(field.index)->GetType();
  double value = 0;
  if (type == OFTInteger || type == OFTInteger64 || type == OFTReal) {
    value = feature.GetFieldAsDouble(field.index);
  } else {
    const std::string words = feature.GetFieldAsString(field.index);
    if (!parse_double(words, value))
      throw InputError(where,
                       "the field " + field.name + " says \"" + words + "\", expected an elevation",
                       "choose another field with --elevation-field, or mend the text");
  }
  if (!std::isfinite(value))
    throw InputError(where,
                     "the field " + field.name + " is " + text(value) + ", expected an elevation");
  return value;
}

// A name like ELEV_FT says that the numbers are no metres.
void check_unit_in_name(const std::string& name, double unit_m, const Where& where) {
  const std::string small = lower(name);
  const bool feet = small.ends_with("_ft") || small.ends_with("feet") || small.ends_with("_foot");
  if (feet && unit_m == 1)
    throw InputError(where, "the field " + name + " is in feet by its name, expected metres",
                     "--elevation-unit-m 0.3048 (or 0.3048006096 for US survey feet)");
}

// --- lines ---------------------------------------------------------------------------------------

// Lines with map coordinates as they stand in the source.
struct RawLines {
  Polylines lines;
  bool has_z = true;             // of every line
  std::vector<double> by_field;  // elevation of each line in the field looked at
};

void append_line(const OGRLineString& line, std::int64_t feature, const Where& where,
                 RawLines& raw) {
  for (int i = 0; i < line.getNumPoints(); ++i) {
    const Vec3 point(line.getX(i), line.getY(i), line.Is3D() ? line.getZ(i) : 0);
    check_finite(point, where);
    raw.lines.points.push_back(point);
  }
  raw.has_z = raw.has_z && line.Is3D() != 0;
  raw.lines.begin.push_back(static_cast<int>(raw.lines.points.size()));
  raw.lines.feature.push_back(feature);
}

// Lowest and highest Z, and whether each line keeps to one height.
struct HeightRange {
  double low = 0, high = 0;
  int first_sloping = -1;  // line
};

HeightRange heights_of(const Polylines& lines) {
  HeightRange range{lines.points.front().z(), lines.points.front().z(), -1};
  for (int l = 0; l < lines.n_lines(); ++l) {
    const auto begin = static_cast<std::size_t>(lines.begin[static_cast<std::size_t>(l)]);
    const auto end = static_cast<std::size_t>(lines.begin[static_cast<std::size_t>(l) + 1]);
    for (std::size_t i = begin; i < end; ++i) {
      const double z = lines.points[i].z();
      range.low = std::min(range.low, z);
      range.high = std::max(range.high, z);
      if (range.first_sloping < 0 && std::abs(z - lines.points[begin].z()) > same_height_m)
        range.first_sloping = l;
    }
  }
  return range;
}

void set_heights(const std::vector<double>& heights, Polylines& lines) {
  for (std::size_t l = 0; l < heights.size(); ++l)
    for (int i = lines.begin[l]; i < lines.begin[l + 1]; ++i)
      lines.points[static_cast<std::size_t>(i)].z() = heights[l];
}

// Z and a field that both look like elevations must say the same: else one is in other units.
void check_same_elevation(const RawLines& raw, const std::string& field, const Where& where) {
  for (std::size_t l = 0; l < raw.by_field.size(); ++l) {
    const double z = raw.lines.points[static_cast<std::size_t>(raw.lines.begin[l])].z();
    if (std::abs(z - raw.by_field[l]) <= 1e-3 * std::max(1.0, std::abs(z))) continue;
    throw InputError(where,
                     "feature " + std::to_string(raw.lines.feature[l]) + " has Z " + text(z, 8) +
                         " and " + field + " " + text(raw.by_field[l], 8) +
                         ", expected the same height: mixed units?",
                     "choose with --elevation-field Z or --elevation-field " + field +
                         "; for feet add --elevation-unit-m 0.3048");
  }
}

std::string elevation_hint(const Source& source) {
  const std::string drawing =
      source.is_drawing ? "; a 2-D drawing has none: draw 3-D polylines" : "";
  return "name the field with --elevation-field; the fields are: " +
         list_of_fields(*source.layer->GetLayerDefn()) + drawing;
}

// Reads the contours and gives each line one height.
Polylines read_contour_lines(const ContourSources& sources, Source& source,
                             ContourReading& reading) {
  const LayerChoice& choice = sources.contours;
  const bool by_user = !sources.elevation_field.empty();
  const std::optional<ElevationField> field =
      by_user ? field_by_user(choice, source, sources.elevation_field) : field_by_name(source);
  const bool reads_field = field && field->index >= 0;
  RawLines raw;
  for_each_part(choice, source, Shape::line, reading.n_ignored, reading.n_features,
                [&](const OGRGeometry& part, const OGRFeature& feature) {
                  const Where where = where_of(choice, source, feature);
                  append_line(*part.toLineString(), feature.GetFID(), where, raw);
                  if (reads_field) raw.by_field.push_back(field_value(feature, *field, where));
                });
  const Where where{choice.path, 0, "layer " + source.name};
  if (raw.lines.points.empty()) throw InputError(where, "there is no line, expected contours");
  const HeightRange z = heights_of(raw.lines);
  const bool z_tells = raw.has_z && z.high - z.low > same_height_m;
  const bool take_field = reads_field && (by_user || !z_tells);
  if (!take_field && (!raw.has_z || (!z_tells && !by_user && z.low == 0)))
    throw InputError(where,
                     "the contours have no elevation: " +
                         std::string(raw.has_z ? "all Z are 0" : "they are 2-D") +
                         " and no field has a known name",
                     elevation_hint(source));
  if (take_field) {
    check_unit_in_name(field->name, sources.elevation_unit_m, where);
    set_heights(raw.by_field, raw.lines);
  } else {
    if (z.first_sloping >= 0)
      throw InputError(
          where,
          "feature " +
              std::to_string(raw.lines.feature[static_cast<std::size_t>(z.first_sloping)]) +
              " changes its height along the line, expected contours",
          "give such lines as --breaklines, or choose a field with --elevation-field");
    if (reads_field) check_same_elevation(raw, field->name, where);
  }
  reading.layer = source.name;
  reading.elevation_from = take_field ? "field " + field->name : "Z";
  return std::move(raw.lines);
}

// --- reference systems ---------------------------------------------------------------------------

std::string crs_of_contours(const ContourSources& sources, const Source& source) {
  const std::string own = wkt_of(source.layer->GetSpatialRef());
  const std::string& path = sources.contours.path;
  if (own.empty() && !sources.crs_given)
    throw InputError({path}, "there is no CRS, expected a projected one in metres",
                     "name it with --crs EPSG:code, or --crs none for local metres");
  if (!own.empty() && sources.crs_given && !same_crs(own, sources.crs))
    throw InputError({path}, "the CRS is " + crs_name(own) + ", not " + crs_name(sources.crs),
                     "leave --crs away; --t-srs reprojects");
  return own.empty() ? sources.crs : own;
}

void check_crs(const std::string& crs, const std::string& path, const Vec3& place) {
  if (crs.empty()) return;
  const CrsProblem problem = find_crs_problem(crs, place.head<2>());
  if (problem.finding.empty()) return;
  throw InputError({path}, problem.finding,
                   "--t-srs " + (problem.mend_to.empty() ? "EPSG:code" : problem.mend_to) +
                       " reprojects; elevations in feet need --elevation-unit-m 0.3048");
}

// Heights stay as they are.
void bring_to(const std::string& from, const std::string& to, const std::string& path,
              std::vector<Vec3>& points) {
  if (!reproject(from, to, points))
    throw InputError({path},
                     "cannot be reprojected from " + crs_name(from) + " to " + crs_name(to));
}

// The CRS of an additional source, reprojected with a note.
void bring_to_map(const LayerChoice& choice, const Source& source, const std::string& map_crs,
                  std::vector<Vec3>& points, ContourReading& reading) {
  const std::string own = wkt_of(source.layer->GetSpatialRef());
  if (own.empty() != map_crs.empty())
    reading.notes.push_back(choice.path + ": taken to be in the CRS of the contours");
  if (own.empty() || map_crs.empty() || same_crs(own, map_crs)) return;
  bring_to(own, map_crs, choice.path, points);
  reading.notes.push_back(choice.path + ": reprojected from " + crs_name(own) + " to " +
                          crs_name(map_crs));
}

// --- breaklines, spot heights, boundary ----------------------------------------------------------

// The height of a feature without Z, from a field of a known name.
std::optional<double> height_in_field(const std::optional<ElevationField>& field,
                                      const OGRFeature& feature, const Where& where) {
  if (!field) return std::nullopt;
  return field_value(feature, *field, where);
}

Polylines read_breaklines(const LayerChoice& choice, const std::string& map_crs, double unit_m,
                          ContourReading& reading) {
  Source source = open_layer(choice, Shape::line, "--breaklines-layer");
  const std::optional<ElevationField> field = field_by_name(source);
  RawLines raw;
  std::int64_t n_features = 0;
  for_each_part(choice, source, Shape::line, reading.n_ignored, n_features,
                [&](const OGRGeometry& part, const OGRFeature& feature) {
                  const Where where = where_of(choice, source, feature);
                  append_line(*part.toLineString(), feature.GetFID(), where, raw);
                  if (part.Is3D()) return;
                  const std::optional<double> height = height_in_field(field, feature, where);
                  if (!height)
                    throw InputError(where, "the breakline has no elevation (2-D), expected Z");
                  const auto begin = raw.lines.begin.end()[-2];
                  for (std::size_t i = static_cast<std::size_t>(begin); i < raw.lines.points.size();
                       ++i)
                    raw.lines.points[i].z() = *height;
                });
  bring_to_map(choice, source, map_crs, raw.lines.points, reading);
  for (Vec3& point : raw.lines.points) point.z() *= unit_m;
  return std::move(raw.lines);
}

std::vector<Vec3> read_spots(const LayerChoice& choice, const std::string& map_crs, double unit_m,
                             ContourReading& reading) {
  Source source = open_layer(choice, Shape::point, "--spots-layer");
  const std::optional<ElevationField> field = field_by_name(source);
  std::vector<Vec3> spots;
  std::int64_t n_features = 0;
  for_each_part(choice, source, Shape::point, reading.n_ignored, n_features,
                [&](const OGRGeometry& part, const OGRFeature& feature) {
                  const Where where = where_of(choice, source, feature);
                  const OGRPoint& point = *part.toPoint();
                  Vec3 spot(point.getX(), point.getY(), point.Is3D() ? point.getZ() : 0);
                  if (!point.Is3D()) {
                    const std::optional<double> height = height_in_field(field, feature, where);
                    if (!height)
                      throw InputError(
                          where, "the spot height has no elevation, expected Z or a field",
                          "the fields are: " + list_of_fields(*source.layer->GetLayerDefn()));
                    spot.z() = *height;
                  }
                  check_finite(spot, where);
                  spots.push_back(spot);
                });
  bring_to_map(choice, source, map_crs, spots, reading);
  for (Vec3& spot : spots) spot.z() *= unit_m;
  return spots;
}

std::vector<std::vector<Vec2>> read_boundary(const LayerChoice& choice, const std::string& map_crs,
                                             ContourReading& reading) {
  Source source = open_layer(choice, Shape::polygon, "--boundary-layer");
  std::vector<Vec3> points;
  std::vector<std::size_t> begin;
  std::int64_t n_features = 0;
  for_each_part(choice, source, Shape::polygon, reading.n_ignored, n_features,
                [&](const OGRGeometry& part, const OGRFeature& feature) {
                  for (const OGRLinearRing* ring : *part.toPolygon()) {
                    begin.push_back(points.size());
                    for (int i = 0; i + 1 < ring->getNumPoints(); ++i) {
                      points.emplace_back(ring->getX(i), ring->getY(i), 0);
                      check_finite(points.back(), where_of(choice, source, feature));
                    }
                  }
                });
  bring_to_map(choice, source, map_crs, points, reading);
  begin.push_back(points.size());
  std::vector<std::vector<Vec2>> rings(begin.size() - 1);
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = begin[r]; i < begin[r + 1]; ++i) rings[r].push_back(points[i].head<2>());
  return rings;
}

// --- the whole map -------------------------------------------------------------------------------

// More than half of the heights far off the contours' range: they are in other units.
void check_units(const std::vector<Vec3>& points, const HeightRange& contours,
                 const std::string& path) {
  const double margin = contours.high - contours.low;
  const auto is_off = [&](const Vec3& p) {
    return p.z() < contours.low - margin || p.z() > contours.high + margin;
  };
  const auto n_off = std::count_if(points.begin(), points.end(), is_off);
  if (2 * n_off <= static_cast<std::ptrdiff_t>(points.size())) return;
  const Vec3& first = *std::find_if(points.begin(), points.end(), is_off);
  throw InputError({path},
                   std::to_string(n_off) + " of " + std::to_string(points.size()) +
                       " heights lie far from the contours, e.g. " + text(first.z(), 8) +
                       " m where contours go from " + text(contours.low, 8) + " to " +
                       text(contours.high, 8) + " m: mixed units?",
                   "convert them to the unit of the contours first");
}

void make_relative(ContourMap& map) {
  Vec3 low = map.contours.points.front();
  for (const Vec3& p : map.contours.points) low = low.cwiseMin(p);
  map.origin = Vec3(std::floor(low.x() / 100) * 100, std::floor(low.y() / 100) * 100, 0);
  for (std::vector<Vec3>* points : {&map.contours.points, &map.breaklines.points, &map.spots})
    for (Vec3& p : *points) p -= map.origin;
  for (std::vector<Vec2>& ring : map.boundary)
    for (Vec2& p : ring) p -= map.origin.head<2>();
}

}  // namespace

ContourMap read_contours(const ContourSources& sources, ContourReading& reading) {
  ContourMap map;
  map.source = sources.contours.path;
  Source source = open_layer(sources.contours, Shape::line, "--layer");
  const std::string own_crs = crs_of_contours(sources, source);
  map.contours = read_contour_lines(sources, source, reading);
  map.crs_wkt = sources.t_srs.empty() ? own_crs : sources.t_srs;
  if (!sources.t_srs.empty()) {
    if (own_crs.empty())
      throw InputError({map.source}, "local metres cannot be reprojected", "leave --t-srs away");
    bring_to(own_crs, sources.t_srs, map.source, map.contours.points);
  }
  check_crs(map.crs_wkt, map.source, map.contours.points.front());
  for (Vec3& point : map.contours.points) point.z() *= sources.elevation_unit_m;
  const HeightRange heights = heights_of(map.contours);
  if (!sources.breaklines.path.empty()) {
    map.breaklines =
        read_breaklines(sources.breaklines, map.crs_wkt, sources.elevation_unit_m, reading);
    check_units(map.breaklines.points, heights, sources.breaklines.path);
  }
  if (!sources.spots.path.empty()) {
    map.spots = read_spots(sources.spots, map.crs_wkt, sources.elevation_unit_m, reading);
    check_units(map.spots, heights, sources.spots.path);
  }
  if (!sources.boundary.path.empty())
    map.boundary = read_boundary(sources.boundary, map.crs_wkt, reading);
  make_relative(map);
  return map;
}

void write_points(const std::string& path, const std::string& layer, const std::string& crs_wkt,
                  const Vec3& origin, const std::vector<Vec3>& points) {
  register_gdal_drivers();
  const GdalErrors errors;
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
  GDALDatasetUniquePtr dataset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  OGRSpatialReference crs;
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (!crs_wkt.empty()) crs.importFromWkt(crs_wkt.c_str());
  OGRLayer* out = dataset ? dataset->CreateLayer(layer.c_str(), crs_wkt.empty() ? nullptr : &crs,
                                                 wkbPoint25D, nullptr)
                          : nullptr;
  bool written = out != nullptr && dataset->StartTransaction() == OGRERR_NONE;
  for (std::size_t i = 0; written && i < points.size(); ++i) {
    OGRFeature feature(out->GetLayerDefn());
    const Vec3 place = points[i] + origin;
    OGRPoint point(place.x(), place.y(), place.z());
    feature.SetGeometry(&point);
    written = out->CreateFeature(&feature) == OGRERR_NONE;
  }
  written = written && dataset->CommitTransaction() == OGRERR_NONE;
  dataset.reset();
  if (!written || errors.failed())
    throw InputError({path}, "cannot be written: " + errors.failure());
}

}  // namespace talus
