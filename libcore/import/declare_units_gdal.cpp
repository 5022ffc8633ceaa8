// The part of import/raw_inputs_gdal.hpp that finds the unit of each layer, in plan and
// height.
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/length_units.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/drawing_unit_gdal.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "import/readings.hpp"
#include "import/systems_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace talus {
namespace {

// The remedies for a drawing: take it in the unit of its header, or in metres whatever that says.
DrawingWays ways_of(const RawLayer& layer, const DrawingUnit& unit) {
  const std::string metres = unit.metres > 0 ? text(unit.metres) : "METRES";
  if (!layer.is_of_site()) {
    const std::string option = option_words(layer.source.role, "--unit-m");
    return {option + metres + ", for plan and heights", option + "1"};
  }
  const auto scaled = [&layer](const std::string& factor) {
    return "ogr2ogr -f GPKG -nln metres metres.gpkg " +
           command_words(parse_source_path(layer.path()).source) + " -dialect sqlite -sql " +
           shell_word("SELECT ScaleCoords(geometry, " + factor + ") AS geometry, * FROM \"" +
                      layer.source.layer->GetName() + "\"");
  };
  return {scaled(metres), scaled("1")};
}

// Metres in one unit of the coordinates of the source; 1 also where the CRS has the unit of the
// drawing, which takes care of it in plan.
double plan_unit_of(const RawLayer& layer, const std::string& crs, ImportReading& reading) {
  const std::string drawing = layer.source.dataset->GetDescription();
  const double by_user_m = layer.source.ref.unit_m;
  if (const std::string doubt = doubt_on_unit(drawing, by_user_m); !doubt.empty())
    reading.doubts.push_back(doubt_on({layer.path()}, doubt));
  return scale_of_drawing(drawing, by_user_m, length_unit_m(crs), layer.where(),
                          window_of(layer.lines.points), ways_of(layer, drawing_unit(drawing)));
}

// The user's unit of heights; 0: none. A system that the user names for the ground is in metres.
double height_unit_by_user(const RawLayer& layer, const InputsRequest& request, bool is_ground) {
  if (request.elevation_unit_m > 0) return request.elevation_unit_m;
  if (layer.source.ref.unit_m > 0) return layer.source.ref.unit_m;
  return is_ground && !request.vertical_crs.empty() && height_crs(layer.crs).empty() ? 1 : 0;
}

double width_m(const RawLayer& layer, const std::string& crs) {
  const MapWindow w = window_of(layer.lines.points);
  const double unit_m = length_unit_m(crs);
  return std::isnan(unit_m) ? 0 : std::max(w.x_max - w.x_min, w.y_max - w.y_min) * unit_m;
}

// Metres in one unit of the heights that were read: by the user, or by their system of heights in
// `crs`.
double height_unit_of(const RawLayer& layer, const std::string& crs, double by_user_m,
                      ImportReading& reading) {
  if (by_user_m > 0) return by_user_m;
  const bool has_option = layer.role != InputRole::reference;
  const std::string option = "--elevation-unit-m ";
  const auto way_to = [&](double unit_m, const std::string& code) {
    return has_option
               ? option + text(unit_m, 12)
               : "name the system of heights with the CRS in the file: ogr2ogr -a_srs " +
                     crs_code(crs) + "+" + code + " named.gpkg " + command_words(layer.path());
  };
  const HeightRange z = heights_of(layer.lines);
  const double width = width_m(layer, crs), plan_m = length_unit_m(crs);
  const std::optional<double> unit_m = height_unit_m(crs);
  if (!unit_m)
    throw InputError(choice_of_height_unit({layer.path()}, plan_m, z.low, z.high, width,
                                           way_to(plan_m, "6360"), way_to(1, "5703")));
  if (unit_m == 1.0 && is_in_feet(layer.taken.elevation_from))
    throw InputError(
        choice_of(where_of_layer(layer.source),
                  "the " + layer.taken.elevation_from + " is in feet by its name, expected metres",
                  {{"as feet", rise_words(z.low * foot_m, z.high * foot_m, width),
                    way_to(foot_m, "6360") + (has_option ? " (US survey feet: 0.3048006096)" : "")},
                   {"as metres", rise_words(z.low, z.high, width), way_to(1, "5703")}}));
  if (unit_m != 1.0)
    reading.notes.push_back(layer.path() + ": heights in " + crs_name(height_crs(crs)) +
                            ", taken to metres");
  return *unit_m;
}

// The system with the user's statement on heights whose file has none; a system of heights holds
// for its own unit.
std::string with_user_heights(const InputsRequest& request, const RawLayer& ground) {
  const double unit_m = ground.taken.unit_m;
  const std::string plan = unit_m != 1 ? horizontal_crs(ground.crs) : ground.crs;
  return with_heights_said(plan, request, ground.path());
}

void record_height_system(RawLayer& layer, const RawInputs& raw) {
  const std::string own = height_crs(layer.own_crs), of_map = height_crs(raw.frame);
  if (!own.empty()) return layer.decide("system of heights", crs_name(own), "the file says it");
  const std::string& said = raw.request.vertical_crs;
  if (!said.empty()) return layer.decide("system of heights", heights_name(said), "--vertical-crs");
  layer.decide("system of heights", of_map.empty() ? "not known" : crs_name(of_map),
               of_map.empty() ? "nothing says it" : "that of the map");
}

}  // namespace

void declare_plan_units(RawInputs& raw) {
  for (RawLayer& layer : raw.layers) {
    if (layer.lines.points.empty() || layer.written != nullptr) continue;
    const std::string& otherwise = &layer == raw.ground() ? raw.request.crs : raw.frame;
    const std::string& crs = layer.own_crs.empty() ? otherwise : layer.own_crs;
    const double unit_m = plan_unit_of(layer, crs, raw.reading);
    layer.decide("unit of plan", unit_m == 1 ? "that of its system" : text(unit_m) + " m",
                 layer.source.ref.unit_m > 0 ? "--unit-m" : "nothing says another one");
    if (unit_m == 1) continue;
    for (Vec3& point : layer.lines.points) point.head<2>() *= unit_m;
  }
}

void declare_height_units(RawInputs& raw) {
  for (RawLayer& layer : raw.layers) {
    if (!layer.has_heights()) continue;
    const bool is_ground = &layer == raw.ground();
    const std::string& own = is_ground ? layer.crs : layer.own_crs;
    layer.taken.unit_m =
        height_unit_of(layer, own.empty() ? raw.frame : own,
                       height_unit_by_user(layer, raw.request, is_ground), raw.reading);
    layer.decide("unit of heights", text(layer.taken.unit_m) + " m",
                 raw.request.elevation_unit_m > 0 ? "--elevation-unit-m"
                 : layer.source.ref.unit_m > 0    ? "--unit-m"
                 : height_crs(own).empty()        ? "nothing says another one"
                                                  : crs_name(height_crs(own)));
    if (!is_ground) continue;
    layer.crs = with_user_heights(raw.request, layer);
    raw.frame = raw.request.t_srs.empty()
                    ? layer.crs
                    : with_heights_of(layer.crs, raw.request.t_srs, {layer.path()});
  }
  for (RawLayer& layer : raw.layers)
    if (layer.has_heights()) record_height_system(layer, raw);
}

}  // namespace talus
