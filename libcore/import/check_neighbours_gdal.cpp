// The part of import/raw_inputs_gdal.hpp that looks whether heights can be, by themselves and
// beside those of other layers.
#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "terrain/elevation.hpp"

namespace talus {

void check_elevation(const Vec3& place, const std::string& path, const char* hint) {
  if (std::abs(place.z()) <= highest_elevation) return;
  throw InputError({path},
                   "the elevation at x " + text(place.x(), 10) + ", y " + text(place.y(), 10) +
                       " is " + text(place.z(), 10) + " m, expected at most " +
                       text(highest_elevation) + " m either way",
                   hint);
}

void check_neighbours(RawInputs& raw) {
  const RawLayer* const contours = raw.find(InputRole::contours);
  if (contours == nullptr) return;
  const HeightRange range = heights_of(contours->lines);
  const double margin = range.high - range.low;
  const auto is_off = [&](const Vec3& p) {
    return p.z() < range.low - margin || p.z() > range.high + margin;
  };
  for (const RawLayer& layer : raw.layers) {
    const std::vector<Vec3>& points = layer.lines.points;
    const auto n_off = std::count_if(points.begin(), points.end(), is_off);
    if (!layer.has_heights() || 2 * n_off <= static_cast<std::ptrdiff_t>(points.size())) continue;
    const Vec3& first = *std::find_if(points.begin(), points.end(), is_off);
    throw InputError({layer.path()},
                     std::to_string(n_off) + " of " + std::to_string(points.size()) +
                         " heights lie far from the contours, e.g. " + text(first.z(), 8) +
                         " m where contours go from " + text(range.low, 8) + " to " +
                         text(range.high, 8) + " m: mixed units?",
                     "convert them to the unit of the contours first");
  }
}

}  // namespace talus
