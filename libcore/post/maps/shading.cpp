// The ground below a map: where it is known, and its shading.
#include "post/maps/shading.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

// Brightness of the ground lit from the north-west at 45 degrees; NaN off the ground.
// Slopes are differences over a cell, one-sided at the terrain's border.
double shade(const Trn& trn, double x, double y) {
  const double d = 0.5 * trn.cell_size;
  const Vec2 low = trn.node0 - Vec2(0, (trn.n_rows - 1) * trn.cell_size);
  const Vec2 high = trn.node0 + Vec2((trn.n_cols - 1) * trn.cell_size, 0);
  const double east = std::min(x + d, high.x()), west = std::max(x - d, low.x());
  const double north = std::min(y + d, high.y()), south = std::max(y - d, low.y());
  Vec2 gradient((elevation_at(trn, east, y) - elevation_at(trn, west, y)) / (east - west),
                (elevation_at(trn, x, north) - elevation_at(trn, x, south)) / (north - south));
  if (std::isnan(gradient.x()) || std::isnan(gradient.y())) {
    if (!contains(trn, x, y)) return std::nan("");
    gradient = triangle_gradient(trn, triangle_at(trn, x, y));
    if (std::isnan(gradient.x() + gradient.y())) return std::nan("");
  }
  const Vec3 normal = Vec3(-gradient.x(), -gradient.y(), 1).normalized();
  const Vec3 light = Vec3(-0.5, 0.5, std::sqrt(0.5));
  return 185 + 70 * std::max(0.0, normal.dot(light));
}

}  // namespace

std::vector<bool> known_cells(const Trn& trn, const PassageGrid& grid) {
  std::vector<bool> known;
  known.reserve(static_cast<std::size_t>(grid.n_rows) * static_cast<std::size_t>(grid.n_cols));
  for (int row = 0; row < grid.n_rows; ++row)
    for (int col = 0; col < grid.n_cols; ++col) {
      bool any = false;
      for (const auto& [right, down] :
           {std::pair{0.5, 0.5}, {0.01, 0.01}, {0.99, 0.01}, {0.01, 0.99}, {0.99, 0.99}}) {
        const Vec2 at = grid.corner + grid.cell_size * Vec2(col + right, -row - down);
        any = any || !std::isnan(elevation_at(trn, at.x(), at.y()));
      }
      known.push_back(any);
    }
  return known;
}

Shading shading_of(const Trn& trn, const PassageGrid& squares) {
  Shading out{squares.n_rows, squares.n_cols, {}};
  for (int r = 0; r < out.n_rows; ++r)
    for (int c = 0; c < out.n_cols; ++c) {
      const Vec2 at = squares.corner + squares.cell_size * Vec2(c + 0.5, -r - 0.5);
      out.brightness.push_back(static_cast<float>(shade(trn, at.x(), at.y())));
    }
  return out;
}

}  // namespace talus
