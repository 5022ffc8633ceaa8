// Lifts a failure surface until no rock ahead blocks the mass.
#include "blocks/daylight_envelope.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

struct Lifting {
  const Trn& ground;
  const Area& area;
  const Trn& bed;
  Vec2 ahead, across;
  double rise;  // per metre in plan, back along the motion
  double width;

  [[nodiscard]] double height(const Vec2& place) const {
    return elevation_at(contains(area, place) ? bed : ground, place.x(), place.y());
  }
  // The highest within a block's width of `place`; unknown ground holds nothing.
  [[nodiscard]] double height_across(const Vec2& place) const {
    double highest = height(place);
    const double step = ground.cell_size / 2;
    for (double off = step; off <= width; off += step)
      for (const double side : {off, -off}) {
        const double z = height(place + side * across);
        if (!(z <= highest)) highest = std::isnan(z) ? highest : z;
      }
    return highest;
  }
};

// The highest rock ahead of `place`, carried back to it; `own` where there is none.
double lifted_height(const Lifting& lift, const Vec2& place, double own) {
  const double step = lift.ground.cell_size / 2;
  double highest = own;
  // An area may come again behind a gap: the march ends well outside of it or off the terrain.
  double beyond = 0;
  for (double r = step; beyond <= cells_beyond * lift.ground.cell_size; r += step) {
    const Vec2 at = place + r * lift.ahead;
    if (!contains(lift.ground, at.x(), at.y())) break;
    beyond = contains(lift.area, at) ? 0 : beyond + step;
    const double z = lift.height_across(at) + r * lift.rise;
    if (z > highest) highest = z;
  }
  return highest;
}

// Whether the area begins within two cells of a place outside, towards `direction`.
bool has_area_towards(const Lifting& lift, const Vec2& place, const Vec2& direction) {
  for (int half_cells = 1; half_cells <= 4; ++half_cells)
    if (contains(lift.area, Vec2(place + 0.5 * half_cells * lift.ground.cell_size * direction)))
      return true;
  return false;
}

// Depth of the lifted bed at the nodes inside that are nearest to an outer one, their mean.
double nearest_depth(const Lifting& lift, const Trn& lifted, int row, int col) {
  constexpr int reach = 2;
  int nearest_sq = 3 * reach * reach, n = 0;
  double sum = 0;
  for (int r = std::max(0, row - reach); r <= std::min(lifted.n_rows - 1, row + reach); ++r)
    for (int c = std::max(0, col - reach); c <= std::min(lifted.n_cols - 1, col + reach); ++c) {
      const int distance_sq = (r - row) * (r - row) + (c - col) * (c - col);
      if (distance_sq > nearest_sq) continue;
      if (!contains(lift.area, Vec2(node_point(lifted, r, c).head<2>()))) continue;
      if (distance_sq < nearest_sq) nearest_sq = distance_sq, sum = 0, n = 0;
      const std::size_t node = node_index(lifted, r, c);
      sum += lift.ground.elevation[node] - lifted.elevation[node];
      ++n;
    }
  return n > 0 ? sum / n : 0;
}

}  // namespace

Trn lifted_to_daylight(const Trn& ground, const Area& area, Trn bed,
                       const DaylightDirection& direction) {
  const Trn hollow = bed;
  const Vec2 ahead(std::sin(direction.azimuth), std::cos(direction.azimuth));
  const Lifting lift{
      ground,         area, hollow, ahead, Vec2(ahead.y(), -ahead.x()), std::tan(direction.plunge),
      direction.width};
  const auto each_lowered = [&](auto change) {
    for (int r = 0; r < ground.n_rows; ++r)
      for (int c = 0; c < ground.n_cols; ++c) {
        const std::size_t node = node_index(ground, r, c);
        const Vec2 place = node_point(ground, r, c).head<2>();
        if (hollow.elevation[node] < ground.elevation[node])
          change(place, contains(area, place), bed.elevation[node], ground.elevation[node], r, c);
      }
  };
  each_lowered([&](const Vec2& place, bool is_inside, double& z, double top, int, int) {
    if (is_inside) z = std::min(top, lifted_height(lift, place, z));
  });
  // Beside the area nodes were lowered so that the bed reaches its outline. At the foot it comes
  // out there; at the back and the sides it continues as deep as it is inside.
  each_lowered([&](const Vec2& place, bool is_inside, double& z, double top, int r, int c) {
    if (is_inside) return;
    const bool is_foot =
        has_area_towards(lift, place, -ahead) && !has_area_towards(lift, place, ahead);
    z = is_foot ? top : top - nearest_depth(lift, bed, r, c);
  });
  return bed;
}

}  // namespace talus
