#include "io/contour_heights_gdal.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/text.hpp"
#include "terrain/contour_labels.hpp"
#include "terrain/elevation.hpp"

namespace talus {
namespace {

// Names under which elevations are found, the most telling first; compared in lower case.
constexpr std::array elevation_names = {
    "elev",         "elevation", "height",     "contour",     "z",        "prop_value", "altitude",
    "alt",          "hoehe",     "höhe",       "kote",        "cota",     "quota",      "elev_m",
    "height_m",     "z_value",   "contour_m",  "elevation_m", "isohypse", "hgt",        "elev_ft",
    "elevation_ft", "height_ft", "contour_ft", "elev_feet"};

// --- elevation in a field ------------------------------------------------------------------------

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

std::string field_option(const OpenLayer& source) {
  return std::string(source.role.options) + "elevation-field";
}

ElevationField field_by_user(const LayerChoice& choice, const OpenLayer& source) {
  OGRFeatureDefn& definition = *source.layer->GetLayerDefn();
  const std::string &name = choice.elevation_field, option = field_option(source);
  const int index = definition.GetFieldIndex(name.c_str());
  if (index >= 0) return {index, definition.GetFieldDefn(index)->GetNameRef(), option};
  if (lower(name) == "z") return {-1, "Z", option};
  throw InputError(
      where_of_layer(choice, source),
      "there is no field \"" + name + "\"; the fields are: " + list_of_fields(definition),
      "choose one with " + option + ", or Z for the geometries' own Z");
}

std::optional<ElevationField> field_by_name(const OpenLayer& source) {
  OGRFeatureDefn& definition = *source.layer->GetLayerDefn();
  for (const char* name : elevation_names)
    for (int i = 0; i < definition.GetFieldCount(); ++i)
      if (lower(definition.GetFieldDefn(i)->GetNameRef()) == name)
        return ElevationField{i, definition.GetFieldDefn(i)->GetNameRef(), field_option(source)};
  return std::nullopt;
}

std::optional<ElevationField> find_field(const LayerChoice& choice, const OpenLayer& source) {
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

// --- lines --------------------------------------------------------------------------------------

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

void set_heights(const std::vector<double>& heights, Polylines& lines) {
  for (std::size_t l = 0; l < heights.size(); ++l)
    for (int i = lines.begin[l]; i < lines.begin[l + 1]; ++i)
      lines.points[static_cast<std::size_t>(i)].z() = heights[l];
}

// What files write where they know no height is no height, whatever its unit.
void check_known(const Polylines& lines, const LayerChoice& choice, const OpenLayer& source,
                 const std::string& from) {
  for (int l = 0; l < lines.n_lines(); ++l)
    for (int i = lines.begin[static_cast<std::size_t>(l)];
         i < lines.begin[static_cast<std::size_t>(l) + 1]; ++i) {
      const Vec3& point = lines.points[static_cast<std::size_t>(i)];
      if (!is_usual_nodata(point.z())) continue;
      const std::string value = text(point.z());
      throw InputError({choice.path, 0,
                        "layer " + source.name + ", feature " +
                            std::to_string(lines.feature[static_cast<std::size_t>(l)]) + " (" +
                            text(point.x(), 10) + ", " + text(point.y(), 10) + ")"},
                       "the elevation is " + value + ", which stands for an unknown one",
                       from == "Z" ? "give the line its height, or take it out: ogr2ogr -where"
                                   : "give it its height, or take such out: ogr2ogr -where \"" +
                                         from + " <> " + value + "\" known.gpkg " + choice.path);
    }
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

std::string elevation_hint(const OpenLayer& source, bool has_z) {
  return "name the field with " + field_option(source) +
         "; the fields are: " + list_of_fields(*source.layer->GetLayerDefn()) +
         (has_z               ? "; or Z where 0 m is meant"
          : source.is_drawing ? "; a 2-D drawing has none: draw 3-D polylines"
                              : "");
}

// Whether the heights stand in the field rather than in Z: the user says so, or Z tells nothing.
// Contours stand at several heights (`heights_differ`); a lake or a single spot at one, but not
// with all Z at 0. Refuses parts that have neither.
bool stand_in_field(const LayerChoice& choice, const OpenLayer& source, const RawLines& raw,
                    const HeightRange& z, const std::optional<ElevationField>& field,
                    bool heights_differ) {
  const bool by_user = !choice.elevation_field.empty();
  const bool all_zero = z.low == 0 && z.high - z.low <= same_height_m;
  const bool one_height_will_do = !heights_differ && !all_zero;
  const bool z_tells = raw.has_z && (one_height_will_do || z.high - z.low > same_height_m);
  if (field && field->index >= 0 && (by_user || !z_tells)) return true;
  if (!raw.has_z || (all_zero && !by_user))
    throw InputError(where_of_layer(choice, source),
                     std::string("the ") + source.role.name +
                         " have no elevation: " + (raw.has_z ? "all Z are 0" : "they are 2-D") +
                         (by_user ? "" : " and no field has a known name"),
                     elevation_hint(source, raw.has_z));
  return false;
}

// The value of the field for each part, in the order of the parts.
std::vector<double> read_field(const LayerChoice& choice, OpenLayer& source,
                               const ElevationField& field) {
  std::vector<double> values;
  for_each_part(choice, source, [&](const OGRGeometry&, const OGRFeature& feature) {
    values.push_back(field_value(feature, field, where_of_feature(choice, source, feature)));
  });
  return values;
}

// --- labels --------------------------------------------------------------------------------------

constexpr LayerRole labels_role{LayerShape::point, "labels", "--labels-"};

// "1050", "1050 m", "1050,5"; other text is no label of a height.
bool parse_label(std::string words, double& height) {
  std::replace(words.begin(), words.end(), ',', '.');
  while (!words.empty() && (words.back() == 'm' || words.back() == ' ')) words.pop_back();
  return parse_double(words, height);
}

int text_field(const LayerChoice& choice, const OpenLayer& source) {
  OGRFeatureDefn& definition = *source.layer->GetLayerDefn();
  const int index = choice.elevation_field.empty()
                        ? definition.GetFieldIndex("Text")
                        : definition.GetFieldIndex(choice.elevation_field.c_str());
  if (index >= 0) return index;
  throw InputError(where_of_layer(choice, source),
                   "there is no field " +
                       (choice.elevation_field.empty() ? "Text" : choice.elevation_field) +
                       "; the fields are: " + list_of_fields(definition),
                   "name the field with the labels' text: --labels-field");
}

std::vector<Vec3> read_labels(const LayerChoice& choice, std::vector<std::string>& notes) {
  OpenLayer source = open_layer(choice, labels_role);
  const int field = text_field(choice, source);
  std::vector<Vec3> labels;
  std::int64_t n_other = 0;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    double height = 0;
    if (parse_label(feature.GetFieldAsString(field), height))
      labels.emplace_back(part.toPoint()->getX(), part.toPoint()->getY(), height);
    else
      ++n_other;
  });
  notes.push_back(choice.path + ": " + counted(static_cast<std::int64_t>(labels.size()), "label") +
                  " of heights" +
                  (n_other > 0 ? "; " + std::to_string(n_other) + " other texts passed over" : ""));
  return labels;
}

std::string where_line(const Polylines& lines, int line) {
  const Vec3& p =
      lines.points[static_cast<std::size_t>(lines.begin[static_cast<std::size_t>(line)])];
  return "feature " + std::to_string(lines.feature[static_cast<std::size_t>(line)]) + ", x " +
         text(p.x(), 10) + ", y " + text(p.y(), 10);
}

std::vector<double> labelled_heights(const LayerChoice& choice, const Polylines& lines,
                                     std::vector<std::string>& notes) {
  const std::vector<Vec3> labels = read_labels(choice, notes);
  const LabelledLines found = heights_from_labels(lines, labels);
  if (found.line_at_two >= 0)
    throw InputError({choice.path},
                     "one contour has the labels " + text(found.two_heights[0], 8) + " and " +
                         text(found.two_heights[1], 8) +
                         " m: " + where_line(lines, found.line_at_two),
                     "move the label that belongs to another line, or part the lines there");
  if (!found.without.empty()) {
    const std::string unclear =
        found.unclear.empty()
            ? std::string()
            : "; " + std::to_string(found.unclear.size()) + " labels stand between two contours";
    throw InputError({choice.path},
                     std::to_string(found.without.size()) + " of " +
                         counted(lines.n_lines(), "contour") + " have no label, the first " +
                         where_line(lines, found.without.front()) + unclear,
                     "give each contour a label, or leave such contours in another layer");
  }
  if (!found.unclear.empty())
    notes.push_back(choice.path + ": " + std::to_string(found.unclear.size()) +
                    " labels between two contours passed over");
  return found.height;
}

}  // namespace

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

Polylines read_contour_lines(const ContourSources& sources, OpenLayer& source,
                             ContourReading& reading) {
  const LayerChoice& choice = sources.contours;
  const bool has_labels = !sources.labels.path.empty();
  const std::optional<ElevationField> field =
      has_labels ? std::nullopt : find_field(choice, source);
  const bool reads_field = field && field->index >= 0;
  RawLines raw;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    const Where where = where_of_feature(choice, source, feature);
    append_part(part, feature.GetFID(), where, raw);
    if (reads_field) raw.by_field.push_back(field_value(feature, *field, where));
  });
  reading.n_features = source.n_features;
  reading.n_ignored += source.n_ignored;
  const Where where = where_of_layer(choice, source);
  if (raw.lines.points.empty())
    throw InputError(where, "there is no line, expected contours",
                     source.is_drawing ? "a surface of faces needs no contours: talus-trn " +
                                             choice.path + " -o terrain.tif --crs EPSG:code"
                                       : std::string());
  if (has_labels) {
    set_heights(labelled_heights(sources.labels, raw.lines, reading.notes), raw.lines);
    reading.layer = source.name;
    reading.elevation_from = "labels";
    return std::move(raw.lines);
  }
  const HeightRange z = heights_of(raw.lines);
  const bool take_field = stand_in_field(choice, source, raw, z, field, true);
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
  check_known(raw.lines, choice, source, take_field ? field->name : "Z");
  reading.layer = source.name;
  reading.elevation_from = take_field ? "field " + field->name : "Z";
  return std::move(raw.lines);
}

Polylines read_measured_lines(const LayerChoice& choice, OpenLayer& source, double unit_m,
                              std::vector<std::string>& notes) {
  const std::optional<ElevationField> field = find_field(choice, source);
  RawLines raw;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    append_part(part, feature.GetFID(), where_of_feature(choice, source, feature), raw);
  });
  const Where where = where_of_layer(choice, source);
  if (raw.lines.points.empty())
    throw InputError(where, std::string("there are no ") + source.role.name);
  const bool take_field = stand_in_field(choice, source, raw, heights_of(raw.lines), field, false);
  if (take_field) {
    check_unit_in_name(field->name, unit_m, where);
    set_heights(read_field(choice, source, *field), raw.lines);
    notes.push_back(choice.path + ": elevation from field " + field->name);
  }
  check_known(raw.lines, choice, source, take_field ? field->name : "Z");
  notes.push_back(choice.path + ": layer " + source.name + ", " +
                  counted(source.n_features, "feature"));
  return std::move(raw.lines);
}

}  // namespace talus
