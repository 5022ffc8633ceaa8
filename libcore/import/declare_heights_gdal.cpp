// The part of import/raw_inputs_gdal.hpp that finds the heights of each layer: in the
// geometries' Z or in a field.
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/length_units.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "import/readings.hpp"
#include "terrain/elevation.hpp"

namespace talus {
namespace {

// The value of a file for an unknown height is not a height, whatever its unit.
void check_known(const RawLayer& layer, const std::string& from) {
  const Polylines& lines = layer.lines;
  for (int l = 0; l < lines.n_lines(); ++l)
    for (int i = lines.begin[l]; i < lines.begin[l + 1]; ++i) {
      const Vec3& point = lines.points[i];
      if (!is_usual_nodata(point.z())) continue;
      const std::string value = text(point.z());
      throw InputError(
          {layer.path(), 0,
           "layer " + layer.source.name + ", feature " + std::to_string(lines.feature[l]) + " (" +
               text(point.x(), 10) + ", " + text(point.y(), 10) + ")"},
          "the elevation is " + value + ", which stands for an unknown one",
          from == "Z" ? "give the line its height, or take it out"
                      : "give it its height, or take such out: ogr2ogr -where \"" + from + " <> " +
                            value + "\" known.gpkg " + command_words(layer.path()));
    }
}

bool is_level(const Polylines& lines, std::size_t line) {
  const double z = lines.points[lines.begin[line]].z();
  return std::all_of(lines.points.begin() + lines.begin[line],
                     lines.points.begin() + lines.begin[line + 1],
                     [z](const Vec3& p) { return std::abs(p.z() - z) <= same_height_m; });
}

// Z and a field that both look like elevations must say the same: else one is in other units. A Z
// that is not a number, or changes along a line, says nothing of the field, and a field of zeros
// nothing at all.
void check_same_elevation(const RawLayer& layer) {
  const Polylines& lines = layer.lines;
  const HeightField& field = *layer.field;
  if (std::all_of(field.values().begin(), field.values().end(), [](double z) { return z == 0; }))
    return;
  const std::string& name = field.name();
  const std::string option = field_option(layer.source);
  const bool is_called_z = lower(name) == "z";
  const auto [low, high] = std::minmax_element(field.values().begin(), field.values().end());
  const HeightRange of_z = heights_of(lines);
  for (std::size_t l = 0; l < field.values().size(); ++l) {
    const double z = lines.points[lines.begin[l]].z(), value = field.values()[l];
    if (!std::isfinite(z) || !differ(z, value) || !is_level(lines, l)) continue;
    const auto reading = [&](const char* of, double lowest, double highest, double unit_m,
                             const std::string& choice) {
      const bool is_feet = unit_m != 1;
      return Reading{std::string(of) + (is_feet ? ", as feet," : ""),
                     rise_words(lowest * unit_m, highest * unit_m, 0),
                     option + choice + (is_feet ? " --elevation-unit-m " + text(unit_m) : "")};
    };
    const auto unit_of = [](double own, double other) {
      return std::abs(own * foot_m / other - 1) < 0.01 ? foot_m : 1;
    };
    throw InputError(choice_of(
        where_of_layer(layer.source),
        "feature " + std::to_string(lines.feature[l]) + " has Z " + text(z, 8) + " and " +
            (is_called_z ? "a field Z of " : name + " ") + text(value, 8) +
            ", expected the same height: mixed units?",
        {reading("by Z", of_z.low, of_z.high, unit_of(z, value), is_called_z ? "geometry.Z" : "Z"),
         reading("by the field", *low, *high, unit_of(value, z),
                 (is_called_z ? "field." : "") + name)}));
  }
}

// Heights are unknown for the splines of a drawing, lines without Z, and lines whose Z is not a
// number.
InputError without_heights(const RawLayer& layer) {
  const OpenLayer& source = layer.source;
  const std::string name = source.role.name, fields = list_of_fields(*source.layer);
  const Where where = where_of_layer(source);
  const std::string n_lines = std::to_string(layer.lines.n_lines());
  const std::string naming =
      "name the field with " + field_option(source) + "FIELD; the fields are: " + fields;
  if (layer.n_no_number > 0 && layer.has_z)
    return InputError(where,
                      "the Z of " + std::to_string(layer.n_no_number) + " of " + n_lines +
                          " is not a finite number, and no field with a usual name holds heights",
                      naming);
  if (source.n_splines > 0)
    return InputError(where,
                      "the " + name + " have no elevation: " + std::to_string(source.n_splines) +
                          " of " + n_lines + " are splines (SPLINE), whose Z GDAL does not read",
                      "turn them into 3-D polylines in the CAD program: SPLINEDIT, or FLATTEN");
  const bool by_user = !source.ref.elevation_field.empty();
  return InputError(where,
                    "the " + name + " have no elevation: " +
                        (layer.has_z ? "all Z are 0"
                         : layer.n_flat < layer.lines.n_lines()
                             ? std::to_string(layer.n_flat) + " of " + n_lines + " are 2-D"
                             : "they are 2-D") +
                        (by_user ? "" : " and no field has a known name"),
                    naming + (layer.has_z         ? "; or Z where 0 m is meant"
                              : source.is_drawing ? "; a 2-D drawing has none: draw 3-D polylines"
                                                  : ""));
}

// Whether the heights are in the field and not in Z: the user says so, or Z tells nothing. Contours
// have several heights; a lake or a single spot has one, but not with all Z at 0. Refuses parts
// that have neither.
bool stand_in_field(const RawLayer& layer) {
  const HeightRange z = heights_of(layer.lines);
  const bool by_user = !layer.source.ref.elevation_field.empty();
  const bool has_z = layer.has_z && layer.n_no_number == 0;
  const bool all_zero = z.low == 0 && z.high - z.low <= same_height_m;
  const bool one_height_will_do = layer.source.role.heights == HeightsOf::points && !all_zero;
  const bool z_tells = has_z && (one_height_will_do || z.high - z.low > same_height_m);
  if (layer.field && !layer.field->is_z() && (by_user || !z_tells)) return true;
  if (!has_z || (all_zero && !by_user)) throw without_heights(layer);
  return false;
}

// Z where the field is taken: it must not contradict the field. A Z at one height says nothing, and
// a field that the user names is meant, but for one that is called Z.
void check_z_beside_field(const RawLayer& layer) {
  const HeightField& field = *layer.field;
  const bool is_looked_at =
      layer.has_z && (field.may_be_z() || (!field.is_by_user() && layer.n_no_number > 0));
  if (!is_looked_at) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& point : layer.lines.points) {
    if (!std::isfinite(point.z())) continue;
    low = std::min(low, point.z());
    high = std::max(high, point.z());
  }
  if (high - low > same_height_m || (field.may_be_z() && high >= low && low != 0))
    check_same_elevation(layer);
}

void take_field(RawLayer& layer) {
  const std::vector<double>& heights = layer.field->heights(layer.source);
  check_z_beside_field(layer);
  Polylines& lines = layer.lines;
  if (layer.n_no_number > 0)
    layer.taken.remarks.push_back("Z of " + std::to_string(layer.n_no_number) + " of " +
                                  std::to_string(lines.n_lines()) +
                                  " is not a number and was ignored");
  for (std::size_t l = 0; l < heights.size(); ++l)
    for (int i = lines.begin[l]; i < lines.begin[l + 1]; ++i) lines.points[i].z() = heights[l];
}

void take_z(const RawLayer& layer) {
  const int sloping = heights_of(layer.lines).first_sloping;
  if (sloping >= 0 && layer.source.role.heights == HeightsOf::level_lines)
    throw InputError(where_of_layer(layer.source),
                     "feature " + std::to_string(layer.lines.feature[sloping]) +
                         " changes its height along the line, expected contours",
                     "give such lines as --breaklines, or choose a field with --elevation-field");
  if (layer.field && !layer.field->is_z()) check_same_elevation(layer);
}

// The features that were taken, and those passed over.
void note_layer(const RawLayer& layer, std::vector<std::string>& notes) {
  const LayerReading& taken = layer.taken;
  if (layer.is_of_site()) return;
  if (layer.role == InputRole::boundary)
    notes.push_back(taken.file + ": layer " + taken.layer + ", " +
                    counted(layer.polygon.back() + 1, "polygon"));
  if (layer.source.role.heights == HeightsOf::points) {
    if (taken.elevation_from != "Z")
      notes.push_back(taken.file + ": elevation from " + taken.elevation_from);
    notes.push_back(taken.file + ": layer " + taken.layer + ", " +
                    counted(taken.n_features, "feature"));
  }
  add_remarks(taken, notes);
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

void declare_heights(RawInputs& raw) {
  RawLayer* const labels = raw.find(InputRole::labels);
  for (RawLayer& layer : raw.layers) {
    if (layer.role == InputRole::contours && labels != nullptr) {
      take_heights_of_labels(layer, *labels, raw);
    } else if (layer.has_heights()) {
      const bool takes_field = stand_in_field(layer);
      takes_field ? take_field(layer) : take_z(layer);
      check_known(layer, takes_field ? layer.field->name() : "Z");
      layer.taken.elevation_from = takes_field ? "field " + layer.field->name() : "Z";
      layer.decide("heights", layer.taken.elevation_from,
                   !layer.source.ref.elevation_field.empty() ? "--elevation-field"
                   : !takes_field                            ? "Z tells heights apart"
                   : layer.has_z                             ? "a usual name, and Z tells nothing"
                                                             : "a usual name, and there is no Z");
    }
    layer.field.reset();
  }
  for (const RawLayer& layer : raw.layers) note_layer(layer, raw.reading.notes);
}

}  // namespace talus
