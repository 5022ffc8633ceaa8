// The part of import/raw_inputs_gdal.hpp that asks which system each layer is in, and whether its
// coordinates can be in it.
#include <ogrsf_frmts.h>

#include <cmath>

#include "base/source_path.hpp"
#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "import/systems_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace talus {
namespace {

constexpr const char* no_degrees =
    " (a GeoJSON without crs says so), but the coordinates are not degrees";

// Coordinates that the user scaled are local metres, whatever unit the file says.
bool make_local_metres(RawLayer& layer) {
  const bool is_scaled = layer.source.ref.unit_m > 0 && is_local(layer.own_crs);
  if (is_scaled) layer.own_crs.clear();
  return is_scaled;
}

// `crs`: the file's, or the user's for a file without one.
void check_local_unit(const RawLayer& layer, const std::string& crs, bool is_ground) {
  const double unit_m = is_local(crs) ? length_unit_m(crs) : 1;
  if (unit_m == 1) return;
  const double height_m = height_unit_m(crs).value_or(unit_m);
  const bool is_alike = !is_ground || std::abs(height_m - unit_m) < 1e-9;
  const std::string hint = (crs == layer.own_crs ? "" : "--crs none ") +
                           option_words(layer.source.role, "--unit-m") + text(unit_m, 10) +
                           (is_alike ? "" : " --elevation-unit-m " + text(height_m, 10));
  throw InputError(
      {layer.path()},
      "the CRS is " + crs_name(crs) + ", in units of " + text(unit_m, 10) + " m, expected metres",
      layer.is_of_site() ? "bring its coordinates to metres"
                         : hint + " scales plan and heights to local metres");
}

// The system of the ground, which the frame follows.
void place_ground(RawLayer& ground, RawInputs& raw) {
  const InputsRequest& request = raw.request;
  const std::vector<Vec3>& points = ground.lines.points;
  const bool is_local_metres = make_local_metres(ground);
  check_local_unit(ground, ground.own_crs, true);
  const bool is_beyond = is_beyond_degrees(ground.own_crs, points);
  if (is_beyond && !request.crs_given)
    throw InputError({ground.path()}, "the CRS is " + crs_name(ground.own_crs) + no_degrees,
                     way_to_name_crs);
  if (!is_local_metres || request.crs_given)
    ground.crs =
        crs_said({ground.path(), is_beyond ? std::string() : ground.own_crs, window_of(points)},
                 request, raw.reading.notes);
  check_local_unit(ground, ground.crs, true);
  ground.decide("system", crs_name(ground.crs),
                is_local_metres                ? "--unit-m"
                : ground.crs == ground.own_crs ? "the file says it"
                                               : "--crs");
  if (ground.crs.empty() && !request.t_srs.empty())
    throw InputError({ground.path()}, "local metres cannot be reprojected", "leave --t-srs away");
  ground.is_in_frame = request.t_srs.empty() || same_crs(ground.crs, request.t_srs);
  if (ground.is_in_frame)
    check_can_be_computed_in(horizontal_crs(ground.crs), points.front(), ground.path());
  raw.frame = ground.is_in_frame ? ground.crs : request.t_srs;
}

// A layer without a system is in the frame; so is one whose system cannot be that of its
// coordinates, but for those of a site, which no option names.
void place_beside(RawLayer& layer, RawInputs& raw) {
  make_local_metres(layer);
  if (raw.frame.empty()) check_local_unit(layer, layer.own_crs, false);
  const bool is_beyond =
      layer.written == nullptr && is_beyond_degrees(layer.own_crs, layer.lines.points);
  layer.is_in_frame = layer.own_crs.empty() || raw.frame.empty() ||
                      same_crs(layer.own_crs, raw.frame) || (is_beyond && !layer.is_of_site());
  layer.crs = layer.is_in_frame ? raw.frame : layer.own_crs;
  layer.decide("system", crs_name(layer.crs),
               is_beyond               ? "the coordinates are not in that of the file"
               : layer.own_crs.empty() ? "the file says none: that of the ground"
                                       : "the file says it");
  if (layer.is_of_site()) {
    if (is_beyond && !layer.is_in_frame)
      throw InputError(layer.where(), "the CRS is " + crs_name(layer.own_crs) + no_degrees,
                       "name the CRS in the file: ogr2ogr -a_srs EPSG:code named.gpkg " +
                           command_words(layer.path()));
    return;
  }
  if (is_beyond || layer.own_crs.empty() != raw.frame.empty())
    raw.reading.notes.push_back(layer.path() + ": taken to be in the CRS of the map" +
                                (is_beyond ? ": its coordinates are not degrees" : ""));
}

// Surveyors of some countries write y to the east and x to the north. A map with a place on the
// Earth shows it, local metres do not: the ground would be its own mirror image.
void doubt_local_axes(RawInputs& raw) {
  if (!raw.frame.empty()) return;
  for (const RawLayer& layer : raw.layers)
    if (layer.source.is_y_first)
      raw.reading.doubts.push_back(
          doubt_on({layer.path()},
                   "the column y stands before x, as where y is the easting, and local metres have "
                   "no place that shows it; expected x to the east",
                   "if y is the easting, exchange the names of the two columns"));
}

}  // namespace

void declare_place(RawInputs& raw) {
  if (RawLayer* const ground = raw.ground()) place_ground(*ground, raw);
  for (RawLayer& layer : raw.layers)
    if (&layer != raw.ground() && !layer.lines.points.empty()) place_beside(layer, raw);
  doubt_local_axes(raw);
}

void check_places(RawInputs& raw) {
  for (const RawLayer& layer : raw.layers) {
    const std::vector<Vec3>& points = layer.lines.points;
    if (layer.crs.empty() || points.empty()) continue;
    CrsExtent place{layer.crs, window_of(points, layer.crs), raw.frame};
    place.has_crs_option = place.has_unit_option = &layer == raw.ground();
    if (layer.written != nullptr) {
      place.crs_said_in = layer.own_crs.empty() ? "the terrain" : "crs of [site]";
    } else {
      place.layer = layer.source.layer->GetName();
      place.geometry_column = layer.source.layer->GetGeometryColumn();
    }
    const Where where =
        layer.written != nullptr ? layer.where() : Where{parse_source_path(layer.path()).source};
    check_place(place, where, raw.reading.doubts);
  }
}

}  // namespace talus
