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
#include "terrain/elevation.hpp"
#include "terrain/tin_mesh.hpp"

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

// What a source is read for: its shape, what its parts are called, how its options begin.
struct Role {
  Shape shape;
  const char* name;
  const char* options;
};
constexpr Role contours_role{Shape::line, "contours", "--"};
constexpr Role breaklines_role{Shape::line, "breaklines", "--breaklines-"};
constexpr Role spots_role{Shape::point, "spot heights", "--spots-"};
constexpr Role boundary_role{Shape::polygon, "boundary", "--boundary-"};
constexpr Role reference_role{Shape::point, "points", "--reference-points-"};

// --- layers --------------------------------------------------------------------------------------

struct Source {
  GDALDatasetUniquePtr dataset;
  OGRLayer* layer = nullptr;
  Role role;
  bool is_drawing = false;  // DXF: one layer holds all sorts of things
  std::string name;         // of the layer, for messages
  // for_each_part
  std::int64_t n_features = 0;
  std::int64_t n_ignored = 0;  // parts of a drawing that have another shape
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

void choose_by_shape(const LayerChoice& choice, Source& source) {
  const Shape shape = source.role.shape;
  std::vector<OGRLayer*> fitting;
  for (OGRLayer* layer : source.dataset->GetLayers())
    if (holds(*layer, shape)) fitting.push_back(layer);
  if (fitting.empty() && source.dataset->GetLayerCount() == 1)
    fitting.push_back(source.dataset->GetLayer(0));  // its features say what is wrong
  if (fitting.size() != 1)
    throw InputError({choice.path},
                     std::to_string(fitting.size()) + " layers hold " + plural(shape) +
                         ", expected one; the layers are: " + list_of_layers(*source.dataset),
                     "choose with " + std::string(source.role.options) + "layer");
  source.layer = fitting.front();
  source.name = source.layer->GetName();
}

Source open_layer(const LayerChoice& choice, const Role& role) {
  Source source;
  source.role = role;
  source.dataset = open_vectors(choice.path);
  source.is_drawing = std::string(source.dataset->GetDriverName()) == "DXF";
  if (choice.layer.empty())
    choose_by_shape(choice, source);
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
// refused too, but in a drawing, where they are counted.
void for_each_part(const LayerChoice& choice, Source& source,
                   const std::function<void(const OGRGeometry&, const OGRFeature&)>& visit) {
  const GdalErrors errors;
  const Shape shape = source.role.shape;
  std::int64_t n_null = 0;
  source.n_features = source.n_ignored = 0;
  const std::function<void(const OGRGeometry&, const OGRFeature&)> descend =
      [&](const OGRGeometry& geometry, const OGRFeature& feature) {
        const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
        if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
          for (const OGRGeometry* part : *geometry.toGeometryCollection()) descend(*part, feature);
        } else if (fits(type, shape)) {
          visit(geometry, feature);
        } else if (source.is_drawing) {
          ++source.n_ignored;
        } else {
          throw InputError(where_of(choice, source, feature), std::string("the geometry is ") +
                                                                  geometry.getGeometryName() +
                                                                  ", expected " + plural(shape));
        }
      };
  source.layer->ResetReading();
  for (const auto& feature : *source.layer) {
    ++source.n_features;
    const OGRGeometry* geometry = feature->GetGeometryRef();
    if (geometry == nullptr || geometry->IsEmpty()) {
      ++n_null;
      continue;
    }
    const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
    descend(*linear, *feature);
  }
  const Where where{choice.path, 0, "layer " + source.name};
  if (source.n_features == 0)
    throw InputError(where, "the layer is empty, expected " + std::string(plural(shape)));
  if (n_null > 0)
    throw InputError(where,
                     std::to_string(n_null) + " of " + std::to_string(source.n_features) +
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
  std::string option;  // that names it
};

std::string list_of_fields(const OGRFeatureDefn& definition) {
  std::string names;
  for (int i = 0; i < definition.GetFieldCount(); ++i)
    names += (i == 0 ? "" : ", ") + std::string(definition.GetFieldDefn(i)->GetNameRef());
  return names.empty() ? "none" : names;
}

std::string field_option(const Source& source) {
  return std::string(source.role.options) + "elevation-field";
}

ElevationField field_by_user(const LayerChoice& choice, const Source& source) {
  OGRFeatureDefn& definition = *source.layer->GetLayerDefn();
  const std::string &name = choice.elevation_field, option = field_option(source);
  const int index = definition.GetFieldIndex(name.c_str());
  if (index >= 0) return {index, definition.GetFieldDefn(index)->GetNameRef(), option};
  if (lower(name) == "z") return {-1, "Z", option};
  throw InputError(
      {choice.path, 0, "layer " + source.name},
      "there is no field \"" + name + "\"; the fields are: " + list_of_fields(definition),
      "choose one with " + option + ", or Z for the geometries' own Z");
}

std::optional<ElevationField> field_by_name(const Source& source) {
  OGRFeatureDefn& definition = *source.layer->GetLayerDefn();
  for (const char* name : elevation_names)
    for (int i = 0; i < definition.GetFieldCount(); ++i)
      if (lower(definition.GetFieldDefn(i)->GetNameRef()) == name)
        return ElevationField{i, definition.GetFieldDefn(i)->GetNameRef(), field_option(source)};
  return std::nullopt;
}

std::optional<ElevationField> find_field(const LayerChoice& choice, const Source& source) {
  if (choice.elevation_field.empty()) return field_by_name(source);
  return field_by_user(choice, source);
}

double field_value(const OGRFeature& feature, const ElevationField& field, const Where& where) {
  if (!feature.IsFieldSetAndNotNull(field.index))
    throw InputError(
        where, "the field " + field.name + " is empty, expected an elevation",
        "choose another field with " + field.option + ", or Z for the geometries' own Z");
  const OGRFieldType type = feature.GetFieldDefnRef(field.index)->GetType();
  double value = 0;
  if (type == OFTInteger || type == OFTInteger64 || type == OFTReal) {
    value = feature.GetFieldAsDouble(field.index);
  } else {
    const std::string words = feature.GetFieldAsString(field.index);
    if (!parse_double(words, value))
      throw InputError(where,
                       "the field " + field.name + " says \"" + words + "\", expected an elevation",
                       "choose another field with " + field.option + ", or mend the text");
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

// Lines with map coordinates as they stand in the source; a point is a line of one point.
struct RawLines {
  Polylines lines;
  bool has_z = true;             // of every line
  std::vector<double> by_field;  // elevation of each line in the field looked at
};

void append_part(const OGRGeometry& part, std::int64_t feature, const Where& where, RawLines& raw) {
  const bool has_z = part.Is3D() != 0;
  const auto add = [&](double x, double y, double z) {
    const Vec3 point(x, y, has_z ? z : 0);
    check_finite(point, where);
    raw.lines.points.push_back(point);
  };
  if (wkbFlatten(part.getGeometryType()) == wkbPoint) {
    const OGRPoint& point = *part.toPoint();
    add(point.getX(), point.getY(), point.getZ());
  } else {
    const OGRLineString& line = *part.toLineString();
    for (int i = 0; i < line.getNumPoints(); ++i) add(line.getX(i), line.getY(i), line.getZ(i));
  }
  raw.has_z = raw.has_z && has_z;
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

std::string elevation_hint(const Source& source, bool has_z) {
  return "name the field with " + field_option(source) +
         "; the fields are: " + list_of_fields(*source.layer->GetLayerDefn()) +
         (has_z               ? "; or Z where 0 m is meant"
          : source.is_drawing ? "; a 2-D drawing has none: draw 3-D polylines"
                              : "");
}

// Whether the heights stand in the field rather than in Z: the user says so, or Z tells nothing.
// Contours stand at several heights; a lake or a single spot at one, but not with all Z at 0.
// Refuses parts that have neither.
bool stand_in_field(const LayerChoice& choice, const Source& source, const RawLines& raw,
                    const HeightRange& z, const std::optional<ElevationField>& field) {
  const bool by_user = !choice.elevation_field.empty();
  const bool all_zero = z.low == 0 && z.high - z.low <= same_height_m;
  const bool one_height_will_do = source.role.name != contours_role.name && !all_zero;
  const bool z_tells = raw.has_z && (one_height_will_do || z.high - z.low > same_height_m);
  if (field && field->index >= 0 && (by_user || !z_tells)) return true;
  if (!raw.has_z || (all_zero && !by_user))
    throw InputError({choice.path, 0, "layer " + source.name},
                     std::string("the ") + source.role.name +
                         " have no elevation: " + (raw.has_z ? "all Z are 0" : "they are 2-D") +
                         (by_user ? "" : " and no field has a known name"),
                     elevation_hint(source, raw.has_z));
  return false;
}

// Reads the contours and gives each line one height.
Polylines read_contour_lines(const ContourSources& sources, Source& source,
                             ContourReading& reading) {
  const LayerChoice& choice = sources.contours;
  const std::optional<ElevationField> field = find_field(choice, source);
  const bool reads_field = field && field->index >= 0;
  RawLines raw;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    const Where where = where_of(choice, source, feature);
    append_part(part, feature.GetFID(), where, raw);
    if (reads_field) raw.by_field.push_back(field_value(feature, *field, where));
  });
  reading.n_features = source.n_features;
  reading.n_ignored += source.n_ignored;
  const Where where{choice.path, 0, "layer " + source.name};
  if (raw.lines.points.empty()) throw InputError(where, "there is no line, expected contours");
  const HeightRange z = heights_of(raw.lines);
  const bool take_field = stand_in_field(choice, source, raw, z, field);
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

std::string crs_of_contours(const ContourSources& sources, const Source& source,
                            const std::vector<Vec3>& points) {
  const std::string named = wkt_of(source.layer->GetSpatialRef());
  const bool no_degrees = is_beyond_degrees(named, points);
  const std::string own = no_degrees ? std::string() : named;
  const std::string& path = sources.contours.path;
  if (own.empty() && !sources.crs_given)
    throw InputError({path},
                     no_degrees ? "the CRS is " + crs_name(named) +
                                      " (a GeoJSON without crs says so), but the coordinates are "
                                      "no degrees"
                                : "there is no CRS, expected a projected one in metres",
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
                  std::vector<Vec3>& points, std::vector<std::string>& notes) {
  const std::string own = wkt_of(source.layer->GetSpatialRef());
  const bool no_degrees = is_beyond_degrees(own, points);
  if (no_degrees || own.empty() != map_crs.empty())
    notes.push_back(choice.path + ": taken to be in the CRS of the map" +
                    (no_degrees ? ": its coordinates are no degrees" : ""));
  if (no_degrees || own.empty() || map_crs.empty() || same_crs(own, map_crs)) return;
  bring_to(own, map_crs, choice.path, points);
  notes.push_back(choice.path + ": reprojected from " + crs_name(own) + " to " + crs_name(map_crs));
}

// --- breaklines, spot heights, boundary ----------------------------------------------------------

// Heights in metres, whatever their unit was.
void scale_heights(double unit_m, const std::string& path, std::vector<Vec3>& points) {
  for (Vec3& point : points) {
    point.z() *= unit_m;
    if (std::abs(point.z()) > highest_elevation)
      throw InputError({path},
                       "the elevation at x " + text(point.x(), 10) + ", y " + text(point.y(), 10) +
                           " is " + text(point.z(), 10) + " m, expected at most " +
                           text(highest_elevation) + " m either way",
                       "feet need --elevation-unit-m 0.3048; choose another field where this one "
                       "holds no elevations");
  }
}

// The value of the field for each part, in the order of the parts.
std::vector<double> read_field(const LayerChoice& choice, Source& source,
                               const ElevationField& field) {
  std::vector<double> values;
  for_each_part(choice, source, [&](const OGRGeometry&, const OGRFeature& feature) {
    values.push_back(field_value(feature, field, where_of(choice, source, feature)));
  });
  return values;
}

// Breaklines, or points as lines of one point, with their heights [m].
Polylines read_measured(const LayerChoice& choice, const Role& role, const std::string& map_crs,
                        double unit_m, std::vector<std::string>& notes) {
  Source source = open_layer(choice, role);
  const std::optional<ElevationField> field = find_field(choice, source);
  RawLines raw;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    append_part(part, feature.GetFID(), where_of(choice, source, feature), raw);
  });
  const Where where{choice.path, 0, "layer " + source.name};
  if (raw.lines.points.empty()) throw InputError(where, std::string("there are no ") + role.name);
  if (stand_in_field(choice, source, raw, heights_of(raw.lines), field)) {
    check_unit_in_name(field->name, unit_m, where);
    set_heights(read_field(choice, source, *field), raw.lines);
    notes.push_back(choice.path + ": elevation from field " + field->name);
  }
  bring_to_map(choice, source, map_crs, raw.lines.points, notes);
  scale_heights(unit_m, choice.path, raw.lines.points);
  return std::move(raw.lines);
}

std::vector<BoundaryRing> read_boundary(const LayerChoice& choice, const std::string& map_crs,
                                        std::vector<std::string>& notes) {
  Source source = open_layer(choice, boundary_role);
  std::vector<Vec3> points;
  std::vector<BoundaryRing> rings;
  std::vector<std::size_t> begin;
  int n_polygons = 0;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    for (const OGRLinearRing* ring : *part.toPolygon()) {
      begin.push_back(points.size());
      rings.push_back({n_polygons, {}});
      for (int i = 0; i + 1 < ring->getNumPoints(); ++i) {
        points.emplace_back(ring->getX(i), ring->getY(i), 0);
        check_finite(points.back(), where_of(choice, source, feature));
      }
    }
    ++n_polygons;
  });
  bring_to_map(choice, source, map_crs, points, notes);
  begin.push_back(points.size());
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = begin[r]; i < begin[r + 1]; ++i)
      rings[r].points.push_back(points[i].head<2>());
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
  for (BoundaryRing& ring : map.boundary)
    for (Vec2& p : ring.points) p -= map.origin.head<2>();
}

}  // namespace

ContourMap read_contours(const ContourSources& sources, ContourReading& reading) {
  ContourMap map;
  map.source = sources.contours.path;
  Source source = open_layer(sources.contours, contours_role);
  map.contours = read_contour_lines(sources, source, reading);
  const std::string own_crs = crs_of_contours(sources, source, map.contours.points);
  map.crs_wkt = sources.t_srs.empty() ? own_crs : sources.t_srs;
  if (!sources.t_srs.empty()) {
    if (own_crs.empty())
      throw InputError({map.source}, "local metres cannot be reprojected", "leave --t-srs away");
    bring_to(own_crs, sources.t_srs, map.source, map.contours.points);
  }
  check_crs(map.crs_wkt, map.source, map.contours.points.front());
  scale_heights(sources.elevation_unit_m, map.source, map.contours.points);
  const HeightRange heights = heights_of(map.contours);
  if (!sources.breaklines.path.empty()) {
    map.breaklines = read_measured(sources.breaklines, breaklines_role, map.crs_wkt,
                                   sources.elevation_unit_m, reading.notes);
    check_units(map.breaklines.points, heights, sources.breaklines.path);
  }
  if (!sources.spots.path.empty()) {
    map.spots = read_measured(sources.spots, spots_role, map.crs_wkt, sources.elevation_unit_m,
                              reading.notes)
                    .points;
    check_units(map.spots, heights, sources.spots.path);
  }
  if (!sources.boundary.path.empty())
    map.boundary = read_boundary(sources.boundary, map.crs_wkt, reading.notes);
  make_relative(map);
  check_boundary(map, sources.boundary.path);
  return map;
}

std::vector<Vec3> read_points(const LayerChoice& choice, const std::string& crs_wkt,
                              std::vector<std::string>& notes) {
  return read_measured(choice, reference_role, crs_wkt, 1, notes).points;
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
