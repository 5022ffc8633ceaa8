#include "import/contour_heights_gdal.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/source_path.hpp"
#include "base/text.hpp"
#include "base/thousands.hpp"
#include "import/drawing_unit_gdal.hpp"
#include "import/point_table.hpp"
#include "io/crs_gdal.hpp"
#include "terrain/contour_labels.hpp"
#include "terrain/elevation.hpp"

namespace talus {
namespace {

// Names under which elevations are found, the most telling first; compared in lower case.
constexpr std::array elevation_names = {
    "elev",         "elevation", "height",     "contour",     "z",        "prop_value", "altitude",
    "alt",          "hoehe",     "höhe",       "kote",        "cota",     "quota",      "elev_m",
    "height_m",     "z_value",   "contour_m",  "elevation_m", "isohypse", "hgt",        "elev_ft",
    "elevation_ft", "height_ft", "contour_ft", "elev_feet",   "h"};

// --- elevation in a field ------------------------------------------------------------------------

// Where the elevation of a feature stands: its Z, or a field, which may have another name in each
// layer.
struct ElevationField {
  std::vector<int> index;  // by layer; empty: Z
  std::string name;
  std::string option;                    // that names it
  std::vector<std::vector<int>> rivals;  // by layer: other fields with a usual name
  bool may_be_z = false;                 // the user says Z, and a field has that name
  bool is_z() const { return index.empty(); }
};

std::string list_of_fields(const OGRFeatureDefn& definition) {
  std::string names;
  for (int i = 0; i < definition.GetFieldCount(); ++i)
    names += (i == 0 ? "" : ", ") + std::string(definition.GetFieldDefn(i)->GetNameRef());
  return names.empty() ? "none" : names;
}

std::string list_of_fields(const OpenLayer& source) {
  return list_of_fields(*source.layer->GetLayerDefn());
}

std::string name_of_field(OGRFeatureDefn& definition, int index) {
  return definition.GetFieldDefn(index)->GetNameRef();
}

std::string field_option(const OpenLayer& source) {
  return option_words(source.role, "--elevation-field");
}

// "--elevation-field FIELD", "--elevation-field spots=FIELD"
std::string with_field(const std::string& option) { return option + "FIELD"; }

// The field of exactly this name, else one that differs in case alone; -1: none.
int find_index(OGRFeatureDefn& definition, const std::string& name) {
  int found = -1;
  for (int i = definition.GetFieldCount() - 1; i >= 0; --i) {
    if (name_of_field(definition, i) == name) return i;
    if (lower(name_of_field(definition, i)) == lower(name)) found = i;
  }
  return found;
}

ElevationField field_by_user(const LayerChoice& choice, const OpenLayer& source) {
  const std::string option = field_option(source), lower_name = lower(choice.elevation_field);
  if (lower_name == "geometry.z") return {{}, "Z", option, {}};
  const bool says_field = lower_name.rfind("field.", 0) == 0;
  const std::string name = choice.elevation_field.substr(says_field ? 6 : 0);
  ElevationField field{{}, name, option, {}, !says_field && lower_name == "z"};
  for (std::size_t l = 0; l < source.layers.size(); ++l) {
    OGRFeatureDefn& definition = *source.layers[l]->GetLayerDefn();
    const int index = find_index(definition, name);
    if (index < 0 && l == 0 && field.may_be_z) return {{}, "Z", option, {}};
    if (index < 0)
      throw InputError(
          {choice.path, 0, std::string("layer ") + source.layers[l]->GetName()},
          "there is no field \"" + name + "\"; the fields are: " + list_of_fields(definition),
          "choose one with " + with_field(option) + ", or Z for the geometries' own Z");
    if (l == 0) field.name = name_of_field(definition, index);
    field.index.push_back(index);
  }
  return field;
}

// "Height" of "Height (m)".
std::string without_unit(const std::string& name) {
  std::string plain = name.substr(0, name.find_first_of("(["));
  plain.erase(plain.find_last_not_of(' ') + 1);
  return plain;
}

// Fields with a usual name, the most telling first.
std::vector<int> fields_with_usual_name(OGRFeatureDefn& definition) {
  std::vector<int> found;
  for (const char* name : elevation_names)
    for (int i = 0; i < definition.GetFieldCount(); ++i)
      if (lower(without_unit(name_of_field(definition, i))) == name) found.push_back(i);
  return found;
}

std::optional<ElevationField> field_by_name(const OpenLayer& source) {
  ElevationField field{{}, "", field_option(source), {}};
  for (OGRLayer* layer : source.layers) {
    OGRFeatureDefn& definition = *layer->GetLayerDefn();
    std::vector<int> found = fields_with_usual_name(definition);
    if (found.empty()) return std::nullopt;
    const std::string name = name_of_field(definition, found.front());
    if (field.name.empty())
      field.name = name;
    else if (field.name.find(name) == std::string::npos)
      field.name += ", " + name;
    field.index.push_back(found.front());
    found.erase(found.begin());
    std::erase_if(found, [&](int i) { return is_in_feet(name_of_field(definition, i)); });
    field.rivals.push_back(std::move(found));
  }
  return field;
}

std::optional<ElevationField> find_field(const LayerChoice& choice, const OpenLayer& source) {
  if (choice.elevation_field.empty()) return field_by_name(source);
  return field_by_user(choice, source);
}

double field_value(const OGRFeature& feature, const ElevationField& field, std::size_t layer,
                   const Where& where) {
  const int index = field.index[layer];
  if (!feature.IsFieldSetAndNotNull(index))
    throw InputError(where, "the field " + field.name + " is empty, expected an elevation",
                     "choose another field with " + with_field(field.option) +
                         ", or Z for the geometries' own Z");
  const OGRFieldType type = feature.GetFieldDefnRef(index)->GetType();
  double value = 0;
  if (type == OFTInteger || type == OFTInteger64 || type == OFTReal) {
    value = feature.GetFieldAsDouble(index);
  } else {
    const std::string words = feature.GetFieldAsString(index);
    if (!parse_double(words, value))
      throw InputError(
          where, "the field " + field.name + " says \"" + words + "\", expected an elevation",
          "choose another field with " + with_field(field.option) + ", or mend the text");
  }
  if (!std::isfinite(value))
    throw InputError(where,
                     "the field " + field.name + " is " + text(value) + ", expected an elevation");
  return value;
}

bool differ(double a, double b) { return std::abs(a - b) > 1e-3 * std::max(1.0, std::abs(a)); }

// The values of a field, and whether another field with a usual name says something else. One that
// has the same value everywhere holds no elevations.
class FieldValues {
 public:
  FieldValues(const LayerChoice& choice, const OpenLayer& source, ElevationField field)
      : choice_(choice), source_(source), field_(std::move(field)) {}

  void add(const OGRFeature& feature) {
    const Where where = where_of_feature(choice_, source_, feature);
    values_.push_back(field_value(feature, field_, source_.current, where));
    const int taken = field_.index[source_.current];
    if (feature.GetFieldDefnRef(taken)->GetType() == OFTString)
      thousands_.add(feature.GetFieldAsString(taken));
    if (field_.rivals.empty()) return;
    for (const int index : field_.rivals[source_.current]) add_rival(feature, index);
  }

  const std::vector<double>& values() const { return values_; }

  // Heights as text: 1.010 may be 1.01 or 1010.
  void check_thousands() const {
    if (!thousands_.is_doubtful()) return;
    std::string whole = thousands_.first();
    whole.erase(1, 1);
    throw InputError(where_of_layer(choice_, source_),
                     "the field " + field_.name + " holds text like \"" + thousands_.first() +
                         "\", which may be " + thousands_.first() +
                         " m or, with a point between "
                         "thousands, " +
                         whole + " m",
                     "make a field of numbers of it (field calculator of QGIS: "
                     "to_real(replace(\"" +
                         field_.name + "\", '.', '')) for thousands, to_real(\"" + field_.name +
                         "\") for metres) and name it with " + field_.option);
  }

  void check_rivals() const {
    for (const auto& [name, rival] : rivals_) {
      if (rival.contradiction.empty() || !rival.varies) continue;
      throw InputError(
          where_of_layer(choice_, source_), rival.contradiction,
          "choose with " + field_.option + field_.name + " or " + field_.option + name);
    }
  }

 private:
  struct Rival {
    double first = 0;
    bool varies = false;
    std::string contradiction;
  };

  void add_rival(const OGRFeature& feature, int index) {
    double value = 0;
    if (!feature.IsFieldSetAndNotNull(index) ||
        !parse_double(feature.GetFieldAsString(index), value))
      return;
    const std::string name = feature.GetFieldDefnRef(index)->GetNameRef();
    Rival& rival = rivals_.try_emplace(name, Rival{value, false, ""}).first->second;
    rival.varies = rival.varies || value != rival.first;
    if (rival.contradiction.empty() && differ(values_.back(), value))
      rival.contradiction = "feature " + std::to_string(feature.GetFID()) + " has " + field_.name +
                            " " + text(values_.back(), 8) + " and " + name + " " + text(value, 8) +
                            ", expected the same height";
  }

  const LayerChoice& choice_;
  const OpenLayer& source_;
  const ElevationField field_;
  std::vector<double> values_;
  ThousandsDoubt thousands_;
  std::map<std::string, Rival> rivals_;
};

// --- lines --------------------------------------------------------------------------------------

// Lines with map coordinates as they stand in the source; a point is a line of one point.
struct RawLines {
  Polylines lines;
  bool has_z = true;             // of every line
  std::int64_t n_flat = 0;       // lines without Z
  std::int64_t n_no_number = 0;  // lines with a Z that is no number
};

void append_part(const OGRGeometry& part, std::int64_t feature, const Where& where, RawLines& raw) {
  const bool has_z = part.Is3D() != 0;
  bool is_number = true;
  const auto add = [&](double x, double y, double z) {
    check_finite({x, y, 0}, where);
    is_number = is_number && (!has_z || std::isfinite(z));
    raw.lines.points.emplace_back(x, y, has_z ? z : 0);
  };
  if (wkbFlatten(part.getGeometryType()) == wkbPoint) {
    const OGRPoint& point = *part.toPoint();
    add(point.getX(), point.getY(), point.getZ());
  } else {
    const OGRLineString& line = *part.toLineString();
    for (int i = 0; i < line.getNumPoints(); ++i) add(line.getX(i), line.getY(i), line.getZ(i));
  }
  raw.has_z = raw.has_z && has_z;
  raw.n_flat += has_z ? 0 : 1;
  raw.n_no_number += is_number ? 0 : 1;
  raw.lines.begin.push_back(static_cast<int>(raw.lines.points.size()));
  raw.lines.feature.push_back(feature);
}

void set_heights(const std::vector<double>& heights, Polylines& lines) {
  for (std::size_t l = 0; l < heights.size(); ++l)
    for (int i = lines.begin[l]; i < lines.begin[l + 1]; ++i) lines.points[i].z() = heights[l];
}

// What files write where they know no height is no height, whatever its unit.
void check_known(const Polylines& lines, const LayerChoice& choice, const OpenLayer& source,
                 const std::string& from) {
  for (int l = 0; l < lines.n_lines(); ++l)
    for (int i = lines.begin[l]; i < lines.begin[l + 1]; ++i) {
      const Vec3& point = lines.points[i];
      if (!is_usual_nodata(point.z())) continue;
      const std::string value = text(point.z());
      throw InputError({choice.path, 0,
                        "layer " + source.name + ", feature " + std::to_string(lines.feature[l]) +
                            " (" + text(point.x(), 10) + ", " + text(point.y(), 10) + ")"},
                       "the elevation is " + value + ", which stands for an unknown one",
                       from == "Z"
                           ? "give the line its height, or take it out"
                           : "give it its height, or take such out: ogr2ogr -where \"" + from +
                                 " <> " + value + "\" known.gpkg " + command_words(choice.path));
    }
}

// Z and a field that both look like elevations must say the same: else one is in other units. A Z
// that is no number says nothing.
void check_same_elevation(const RawLines& raw, const std::vector<double>& by_field,
                          const ElevationField& field, const Where& where) {
  const std::string& name = field.name;
  const bool is_called_z = lower(name) == "z";
  for (std::size_t l = 0; l < by_field.size(); ++l) {
    const double z = raw.lines.points[raw.lines.begin[l]].z();
    if (!std::isfinite(z) || !differ(z, by_field[l])) continue;
    throw InputError(where,
                     "feature " + std::to_string(raw.lines.feature[l]) + " has Z " + text(z, 8) +
                         " and " + (is_called_z ? "a field Z of " : name + " ") +
                         text(by_field[l], 8) + ", expected the same height: mixed units?",
                     "choose with " + field.option + (is_called_z ? "geometry.Z or " : "Z or ") +
                         field.option + (is_called_z ? "field." : "") + name +
                         "; for feet add --elevation-unit-m 0.3048");
  }
}

std::string elevation_hint(const OpenLayer& source, bool has_z) {
  return "name the field with " + with_field(field_option(source)) +
         "; the fields are: " + list_of_fields(source) +
         (has_z               ? "; or Z where 0 m is meant"
          : source.is_drawing ? "; a 2-D drawing has none: draw 3-D polylines"
                              : "");
}

// No height is known of the splines of a drawing, of lines without Z, or of those whose Z is no
// number.
InputError without_heights(const LayerChoice& choice, const OpenLayer& source, const RawLines& raw,
                           bool by_user) {
  const std::string name = source.role.name;
  const Where where = where_of_layer(choice, source);
  const std::string n_lines = std::to_string(raw.lines.n_lines());
  if (raw.n_no_number > 0 && raw.has_z)
    return InputError(where,
                      "the Z of " + std::to_string(raw.n_no_number) + " of " + n_lines +
                          " is not a finite number, and no field with a usual name holds heights",
                      "name the field with " + with_field(field_option(source)) +
                          "; the fields are: " + list_of_fields(source));
  if (source.n_splines > 0)
    return InputError(where,
                      "the " + name + " have no elevation: " + std::to_string(source.n_splines) +
                          " of " + n_lines + " are splines (SPLINE), whose Z GDAL does not read",
                      "turn them into 3-D polylines in the CAD program: SPLINEDIT, or FLATTEN");
  return InputError(where,
                    "the " + name + " have no elevation: " +
                        (raw.has_z ? "all Z are 0"
                         : raw.n_flat < raw.lines.n_lines()
                             ? std::to_string(raw.n_flat) + " of " + n_lines + " are 2-D"
                             : "they are 2-D") +
                        (by_user ? "" : " and no field has a known name"),
                    elevation_hint(source, raw.has_z));
}

// Whether the heights stand in the field rather than in Z: the user says so, or Z tells nothing.
// Contours stand at several heights (`heights_differ`); a lake or a single spot at one, but not
// with all Z at 0. Refuses parts that have neither.
bool stand_in_field(const LayerChoice& choice, const OpenLayer& source, const RawLines& raw,
                    const HeightRange& z, const std::optional<ElevationField>& field,
                    bool heights_differ) {
  const bool by_user = !choice.elevation_field.empty(), has_z = raw.has_z && raw.n_no_number == 0;
  const bool all_zero = z.low == 0 && z.high - z.low <= same_height_m;
  const bool one_height_will_do = !heights_differ && !all_zero;
  const bool z_tells = has_z && (one_height_will_do || z.high - z.low > same_height_m);
  if (field && !field->is_z() && (by_user || !z_tells)) return true;
  if (!has_z || (all_zero && !by_user)) throw without_heights(choice, source, raw, by_user);
  return false;
}

// Z where the field is taken: what it says must not be something else. A Z at one height says
// nothing, and a field that the user names is meant, but for one that is called Z.
void check_z_beside_field(const LayerChoice& choice, const OpenLayer& source, const RawLines& raw,
                          const ElevationField& field, const std::vector<double>& by_field) {
  const bool is_looked_at =
      raw.has_z && (field.may_be_z || (choice.elevation_field.empty() && raw.n_no_number > 0));
  if (!is_looked_at) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& point : raw.lines.points) {
    if (!std::isfinite(point.z())) continue;
    low = std::min(low, point.z());
    high = std::max(high, point.z());
  }
  if (high - low > same_height_m || (field.may_be_z && high >= low && low != 0))
    check_same_elevation(raw, by_field, field, where_of_layer(choice, source));
}

std::string remark_on_z(const RawLines& raw) {
  return "Z of " + std::to_string(raw.n_no_number) + " of " + std::to_string(raw.lines.n_lines()) +
         " is no number and was not looked at";
}

}  // namespace

HeightRange heights_of(const Polylines& lines) {
  HeightRange range{lines.points.front().z(), lines.points.front().z(), -1};
  for (int l = 0; l < lines.n_lines(); ++l) {
    const auto begin = static_cast<std::size_t>(lines.begin[l]);
    const auto end = static_cast<std::size_t>(lines.begin[l + 1]);
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

namespace {

// --- labels --------------------------------------------------------------------------------------

constexpr LayerRole labels_role{LayerShape::point, "labels", "labels", true};

// "1050", "1050 m", "1050,5"; other text is no label of a height.
bool parse_label(std::string words, double& height) {
  while (!words.empty() && (words.back() == 'm' || words.back() == ' ')) words.pop_back();
  return parse_decimal(words, height);
}

int text_field(const LayerChoice& choice, const OpenLayer& source) {
  OGRFeatureDefn& definition = *source.layers[source.current]->GetLayerDefn();
  const std::string name = choice.elevation_field.empty() ? "Text" : choice.elevation_field;
  const int index = find_index(definition, name);
  if (index >= 0) return index;
  throw InputError(where_of_layer(choice, source),
                   "there is no field " + name + "; the fields are: " + list_of_fields(definition),
                   "name the field with the labels' text: --elevation-field labels=FIELD");
}

std::vector<Vec3> read_labels(const LayerChoice& choice, OpenLayer& source,
                              ContourReading& reading) {
  std::vector<Vec3> labels;
  std::int64_t n_other = 0;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    const OGRPoint& point = *part.toPoint();
    double height = 0;
    if (parse_label(feature.GetFieldAsString(text_field(choice, source)), height))
      labels.emplace_back(point.getX(), point.getY(), height);
    else
      ++n_other;
  });
  reading.labels = reading_of(choice, source);
  reading.labels.elevation_from = "labels";
  reading.notes.push_back(
      without_layer(choice.path) + ": " +
      counted(static_cast<std::int64_t>(labels.size()), "label") + " of heights" +
      (n_other > 0 ? "; " + counted(n_other, "other text") + " passed over" : std::string()));
  add_remarks(reading.labels, reading.notes);
  return labels;
}

// Labels stand beside the lines only where both are in one system and one unit.
void check_labels_beside(const ContourSources& sources, const OpenLayer& contours,
                         const OpenLayer& labels) {
  const std::string of_contours = wkt_of(contours.layer->GetSpatialRef());
  const std::string of_labels = wkt_of(labels.layer->GetSpatialRef());
  if (!of_contours.empty() && !of_labels.empty() && !same_crs(of_contours, of_labels))
    throw InputError({sources.labels.path},
                     "the labels are in " + crs_name(of_labels) + ", the contours in " +
                         crs_name(of_contours) + ", expected one CRS",
                     "ogr2ogr -t_srs " + crs_code(of_contours) + " labels.gpkg " +
                         command_words(sources.labels.path) + " takes them there");
  const DrawingUnit drawn = drawing_unit(contours.dataset->GetDescription());
  const DrawingUnit written = drawing_unit(labels.dataset->GetDescription());
  if (drawn.metres > 0 && written.metres > 0 && drawn.metres != written.metres)
    throw InputError({sources.labels.path},
                     "the labels are drawn in " + written.name + ", the contours in " + drawn.name +
                         ", expected one unit",
                     "bring the drawings to one unit first");
}

std::string where_line(const Polylines& lines, int line) {
  const Vec3& p = lines.points[lines.begin[line]];
  return "feature " + std::to_string(lines.feature[line]) + ", x " + text(p.x(), 10) + ", y " +
         text(p.y(), 10);
}

void check_labelled(const std::string& path, const Polylines& lines, const LabelledLines& found) {
  if (found.line_at_two >= 0)
    throw InputError({path},
                     "one contour has the labels " + text(found.two_heights[0], 8) + " and " +
                         text(found.two_heights[1], 8) +
                         " m: " + where_line(lines, found.line_at_two),
                     "move the label that belongs to another line, or part the lines there");
  if (found.without.empty()) return;
  const std::string unclear =
      found.unclear.empty()
          ? std::string()
          : "; " + counted(static_cast<std::int64_t>(found.unclear.size()), "label") +
                " between two contours";
  throw InputError({path},
                   std::to_string(found.without.size()) + " of " +
                       counted(lines.n_lines(), "contour") + " have no label, the first " +
                       where_line(lines, found.without.front()) + unclear,
                   "give each contour a label, or leave such contours in another layer");
}

// A Z that tells the lines apart must say what their labels say.
void check_z_beside_labels(const ContourSources& sources, const RawLines& raw,
                           const std::vector<double>& heights) {
  const HeightRange z = heights_of(raw.lines);
  if (!raw.has_z || raw.n_no_number > 0 || z.high - z.low <= same_height_m) return;
  for (std::size_t l = 0; l < heights.size(); ++l) {
    const double own = raw.lines.points[raw.lines.begin[l]].z();
    if (!differ(own, heights[l])) continue;
    throw InputError({sources.labels.path},
                     "the label says " + text(heights[l], 8) + ", the Z of the contour " +
                         text(own, 8) + ": " + where_line(raw.lines, static_cast<int>(l)),
                     "leave --labels away where Z is right");
  }
}

Polylines with_labelled_heights(const ContourSources& sources, const OpenLayer& contours,
                                RawLines raw, ContourReading& reading) {
  const LayerChoice& choice = sources.labels;
  OpenLayer source = open_layer(choice, labels_role);
  check_labels_beside(sources, contours, source);
  const LabelledLines found = heights_from_labels(raw.lines, read_labels(choice, source, reading));
  check_labelled(choice.path, raw.lines, found);
  check_z_beside_labels(sources, raw, found.height);
  if (!found.unclear.empty())
    reading.notes.push_back(without_layer(choice.path) + ": " +
                            counted(static_cast<std::int64_t>(found.unclear.size()), "label") +
                            " between two contours passed over");
  set_heights(found.height, raw.lines);
  reading.layer = contours.name;
  reading.elevation_from = reading.contours.elevation_from = "labels";
  return std::move(raw.lines);
}

}  // namespace

Polylines read_contour_lines(const ContourSources& sources, OpenLayer& source,
                             ContourReading& reading) {
  const LayerChoice& choice = sources.contours;
  const bool has_labels = !sources.labels.path.empty();
  const std::optional<ElevationField> field =
      has_labels ? std::nullopt : find_field(choice, source);
  const bool reads_field = field && !field->is_z();
  RawLines raw;
  FieldValues values(choice, source, field.value_or(ElevationField{}));
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    append_part(part, feature.GetFID(), where_of_feature(choice, source, feature), raw);
    if (reads_field) values.add(feature);
  });
  reading.n_features = source.n_features;
  reading.contours = reading_of(choice, source);
  const Where where = where_of_layer(choice, source);
  if (has_labels) return with_labelled_heights(sources, source, std::move(raw), reading);
  const HeightRange z = heights_of(raw.lines);
  const bool take_field = stand_in_field(choice, source, raw, z, field, true);
  if (take_field) {
    values.check_thousands();
    if (choice.elevation_field.empty()) values.check_rivals();
    check_z_beside_field(choice, source, raw, *field, values.values());
    if (raw.n_no_number > 0) reading.contours.remarks.push_back(remark_on_z(raw));
    set_heights(values.values(), raw.lines);
  } else {
    if (z.first_sloping >= 0)
      throw InputError(where,
                       "feature " + std::to_string(raw.lines.feature[z.first_sloping]) +
                           " changes its height along the line, expected contours",
                       "give such lines as --breaklines, or choose a field with --elevation-field");
    if (reads_field) check_same_elevation(raw, values.values(), *field, where);
  }
  check_known(raw.lines, choice, source, take_field ? field->name : "Z");
  reading.layer = source.name;
  reading.elevation_from = take_field ? "field " + field->name : "Z";
  reading.contours.elevation_from = reading.elevation_from;
  return std::move(raw.lines);
}

Polylines read_measured_lines(const LayerChoice& choice, OpenLayer& source,
                              std::vector<std::string>& notes, LayerReading& taken) {
  const std::optional<ElevationField> field = find_field(choice, source);
  RawLines raw;
  for_each_part(choice, source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    append_part(part, feature.GetFID(), where_of_feature(choice, source, feature), raw);
  });
  taken = reading_of(choice, source);
  const Where where = where_of_layer(choice, source);
  const bool take_field = stand_in_field(choice, source, raw, heights_of(raw.lines), field, false);
  if (take_field) {
    FieldValues values(choice, source, *field);
    for_each_part(choice, source,
                  [&](const OGRGeometry&, const OGRFeature& feature) { values.add(feature); });
    values.check_thousands();
    if (choice.elevation_field.empty()) values.check_rivals();
    check_z_beside_field(choice, source, raw, *field, values.values());
    if (raw.n_no_number > 0) taken.remarks.push_back(remark_on_z(raw));
    set_heights(values.values(), raw.lines);
    notes.push_back(without_layer(choice.path) + ": elevation from field " + field->name);
  }
  check_known(raw.lines, choice, source, take_field ? field->name : "Z");
  notes.push_back(without_layer(choice.path) + ": layer " + source.name + ", " +
                  counted(source.n_features, "feature"));
  taken.elevation_from = take_field ? "field " + field->name : "Z";
  add_remarks(taken, notes);
  return std::move(raw.lines);
}

bool is_in_feet(const std::string& name) {
  std::string small = lower(name);
  std::erase_if(small, [](char c) { return c == ')' || c == ']' || c == ' '; });
  for (const char* end : {"_ft", "feet", "_foot", "(ft", "[ft", "(foot", "[foot"})
    if (small.ends_with(end)) return true;
  return false;
}

void add_remarks(const LayerReading& taken, std::vector<std::string>& notes) {
  if (!taken.where.empty()) notes.push_back(taken.file + ": filter " + taken.where);
  for (const std::string& remark : taken.remarks) notes.push_back(taken.file + ": " + remark);
  if (taken.n_passed_over > 0)
    notes.push_back(taken.file + ": layer " + taken.layer + " also holds " + taken.passed_over +
                    ", passed over");
}

}  // namespace talus
