// Curvature of a sloping local base level (SLBL), from its sag or from usual scenarios.
#include "blocks/base_level.hpp"

#include <cmath>
#include <numbers>

#include "blocks/failure_plane.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

// Centre of area of the outlines; holes count as their rings run.
Vec2 centre_of(const Area& area) {
  const Vec2 zero = area.rings[0][0];
  Vec2 sum = Vec2::Zero();
  double twice = 0;
  for (const auto& ring : area.rings)
    for (size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = ring[k] - zero, b = ring[(k + 1) % ring.size()] - zero;
      const double parallelogram = cross(a, b);
      twice += parallelogram;
      sum += parallelogram * (a + b) / 3;
    }
  return twice != 0 ? Vec2(zero + sum / twice) : zero;
}

// From `start`, how far the area goes along `direction`, to a hundredth of a cell [m].
double reach_along(const Trn& ground, const Area& area, const Vec2& start, const Vec2& direction) {
  const double step = ground.cell_size / 4;
  const double most = ground.cell_size * (ground.n_rows + ground.n_cols);
  double reach = 0;
  for (double r = step; r < most; r += step)
    if (contains(area, Vec2(start + r * direction))) reach = r;
  double low = reach, high = reach + step;
  while (high - low > 0.01 * ground.cell_size) {
    const double middle = (low + high) / 2;
    (contains(area, Vec2(start + middle * direction)) ? low : high) = middle;
  }
  return low;
}

}  // namespace

SourceProfile source_profile(const Trn& ground, const Area& area) {
  const double azimuth = mean_slope(ground, area).dip_direction;
  const Vec2 down(std::sin(azimuth), std::cos(azimuth));
  const Vec2 middle = centre_of(area);
  SourceProfile profile;
  profile.top = middle - reach_along(ground, area, middle, -down) * down;
  profile.foot = middle + reach_along(ground, area, middle, down) * down;
  profile.length = (profile.foot - profile.top).norm();
  profile.height = elevation_at(ground, profile.top.x(), profile.top.y()) -
                   elevation_at(ground, profile.foot.x(), profile.foot.y());
  return profile;
}

double curvature_of_sag(double sag, double length, double cell_size) {
  const double cells = length / cell_size;
  return 4 * sag / (cells * cells);
}

double largest_sag(double height) { return (std::numbers::sqrt2 - 1) * height; }

}  // namespace talus
