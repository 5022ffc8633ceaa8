// The part of import/raw_inputs_gdal.hpp that checks whether heights are plausible, on their own
// and beside those of other layers.
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/length_units.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "import/readings.hpp"
#include "terrain/elevation.hpp"

namespace talus {
namespace {

std::string in_metres(const HeightRange& z, double unit_m) {
  return rise_words(z.low * unit_m, z.high * unit_m, 0);
}

// Points with their heights in another unit. A line with Z has no such command.
std::string way_to_unit(const RawLayer& layer, double unit_m) {
  const std::string& from = layer.taken.elevation_from;
  const bool is_z = from == "Z";
  if (is_z && layer.source.role.heights != HeightsOf::points) return "convert them first";
  OGRLayer& source = *layer.source.layer;
  const std::string column = source.GetGeometryColumn();
  const std::string geometry = column.empty() ? "geometry" : column;
  const std::string z =
      is_z ? "ST_Z(" + geometry + ")" : "\"" + from.substr(std::string("field ").size()) + "\"";
  return "ogr2ogr -f GPKG -nln metres metres.gpkg " +
         command_words(parse_source_path(layer.path()).source) + " -dialect sqlite -sql " +
         shell_word("SELECT CastToXY(" + geometry + ") AS " + geometry + ", " + z + " * " +
                    text(unit_m) + " AS elevation FROM \"" + source.GetName() + "\"");
}

}  // namespace

void check_elevations(const std::vector<Vec3>& points, const Vec3& origin, const Where& where,
                      const std::string& option) {
  const auto is_beyond = [&](const Vec3& p) {
    return std::abs(p.z() + origin.z()) > highest_elevation;
  };
  const auto beyond = std::find_if(points.begin(), points.end(), is_beyond);
  if (beyond == points.end()) return;
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  const HeightRange z{low->z() + origin.z(), high->z() + origin.z()};
  const Vec3 place = *beyond + origin;
  const std::string finding = "the elevation at x " + text(place.x(), 10) + ", y " +
                              text(place.y(), 10) + " is " + text(place.z(), 10) +
                              " m, expected at most " + text(highest_elevation) + " m either way";
  Doubt doubt = doubt_on(where, finding);
  if (!option.empty()) {
    const MapWindow w = window_of(points);
    doubt = choice_of(where, finding,
                      smaller_units(z.low, z.high, std::max(w.x_max - w.x_min, w.y_max - w.y_min),
                                    [&](double unit_m) { return option + text(unit_m); }));
    doubt.hint += std::string(doubt.hint.empty() ? "" : "; ") +
                  "choose another field where this one holds no elevations";
  }
  doubt.at = {place};
  throw InputError(std::move(doubt));
}

void check_neighbours(RawInputs& raw) {
  const RawLayer* const contours = raw.find(InputRole::contours);
  if (contours == nullptr) return;
  const HeightRange range = heights_of(contours->lines);
  const double margin = range.high - range.low;
  const auto is_off = [&](double z) { return z < range.low - margin || z > range.high + margin; };
  for (const RawLayer& layer : raw.layers) {
    const std::vector<Vec3>& points = layer.lines.points;
    const auto n_off =
        std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return is_off(p.z()); });
    if (!layer.has_heights() || 2 * n_off <= static_cast<std::ptrdiff_t>(points.size())) continue;
    const HeightRange z = heights_of(layer.lines);
    std::vector<Reading> readings = {
        {"as they are", in_metres(z, 1), "they belong to another map: leave them out"}};
    for (const auto& [name, unit_m] :
         {std::pair("as feet", foot_m), {"as decimetres", 0.1}, {"as centimetres", 0.01}})
      if (!is_off(z.low * unit_m) && !is_off(z.high * unit_m))
        readings.insert(readings.begin(), {name, in_metres(z, unit_m), way_to_unit(layer, unit_m)});
    Doubt doubt = choice_of({layer.path()},
                            std::to_string(n_off) + " of " + std::to_string(points.size()) +
                                " heights lie far from the contours, which go from " +
                                text(range.low, 8) + " to " + text(range.high, 8) + " m",
                            readings);
    const MapWindow w = window_of(points);
    doubt.at = {{w.x_min, w.y_min, z.low}, {w.x_max, w.y_max, z.high}};
    throw InputError(std::move(doubt));
  }
}

}  // namespace talus
