// Tells whether the values of a failure raster are elevations or depths.
#include "blocks/failure_raster.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "base/percentile.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

constexpr double share_of_ground = 0.3;  // no failure surface lies so far below all ground

// The raster and the ground at the known nodes inside the source.
struct ValuesInside {
  std::vector<double> raster, ground;  // [m], as the raster has them and on the map
  Vec2 lowest_at = Vec2::Zero();       // of the lowest value, local
};

ValuesInside values_inside(const Trn& ground, const Area& area, const std::vector<double>& raster) {
  Vec2 low = Vec2::Constant(infinity), high = -low;
  for (const auto& ring : area.rings)
    for (const Vec2& p : ring) low = low.cwiseMin(p), high = high.cwiseMax(p);
  ValuesInside values;
  double lowest = infinity;
  for (int r = 0; r < ground.n_rows; ++r)
    for (int c = 0; c < ground.n_cols; ++c) {
      const std::size_t i = node_index(ground, r, c);
      const Vec2 p = node_point(ground, r, c).head<2>();
      const bool is_near = (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
      if (std::isnan(raster[i]) || std::isnan(ground.elevation[i]) || !is_near ||
          !contains(area, p))
        continue;
      values.raster.push_back(raster[i]);
      values.ground.push_back(ground.elevation[i] + ground.origin.z());
      if (raster[i] < lowest) lowest = raster[i], values.lowest_at = p;
    }
  return values;
}

double lowest(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}

// Between the 16th and the 84th percentile.
double spread(const std::vector<double>& values) {
  return percentile(values, 0.84) - percentile(values, 0.16);
}

// Elevations have the relief of the ground: below it they change less than on their own.
bool has_relief_of_ground(const ValuesInside& values) {
  std::vector<double> below;
  for (std::size_t i = 0; i < values.raster.size(); ++i)
    below.push_back(values.ground[i] - values.raster[i]);
  return spread(below) < spread(values.raster) / 2;
}

}  // namespace

void check_is_surface(const Trn& ground, const Area& area, const std::vector<double>& elevation,
                      const Where& where) {
  const ValuesInside values = values_inside(ground, area, elevation);
  if (values.raster.empty()) return;
  const double middle = median(values.raster), ground_low = lowest(values.ground);
  const bool is_depth = lowest(values.raster) >= 0 && middle < share_of_ground * ground_low &&
                        median(values.ground) - middle > std::sqrt(area_of(area)) / 2;
  if (!is_depth) return;
  throw InputError(where,
                   "half of its values in the source are below " + text(middle, 4) +
                       ", the ground there lies at " + text(ground_low, 6) +
                       " m and above: these are depths, expected elevations of the surface",
                   "for depths of the mass set source.failure_surface = \"thickness\"");
}

void lower_by_thickness(const Trn& ground, const Area& area, const Where& where,
                        std::vector<double>& depth) {
  const ValuesInside values = values_inside(ground, area, depth);
  if (!values.raster.empty() && has_relief_of_ground(values))
    throw InputError(where,
                     "its values in the source, " + text(lowest(values.raster), 6) +
                         " m and above, rise and fall with the ground there, " +
                         text(lowest(values.ground), 6) +
                         " m and above: these are elevations, expected depths of the mass",
                     "for elevations of the surface set source.failure_surface = \"raster\"");
  if (!values.raster.empty() && lowest(values.raster) < 0) {
    const Vec2 at = values.lowest_at + ground.origin.head<2>();
    throw InputError(where,
                     "the thickness is " + text(lowest(values.raster), 6) + " m at x " +
                         text(at.x(), 10) + ", y " + text(at.y(), 10) + ", expected 0 or more",
                     "heights lost minus, heights gained plus? Turn the sign: gdal_calc.py -A " +
                         command_words(where.file) + " --calc=-A --outfile turned.tif");
  }
  for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = ground.elevation[i] - depth[i];
}

}  // namespace talus
