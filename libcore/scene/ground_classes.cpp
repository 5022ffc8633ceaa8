#include "scene/ground_classes.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

// x of all crossings of the area's rings with the horizontal line at y, sorted.
std::vector<double> crossings_at(const GroundArea& area, double y) {
  std::vector<double> xs;
  for (const std::vector<Vec2>& ring : area.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      xs.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  std::sort(xs.begin(), xs.end());
  return xs;
}

}  // namespace

void paint_areas(const Trn& trn, const std::vector<GroundArea>& areas,
                 std::vector<std::uint8_t>& classes) {
  const int n_rows = trn.n_rows - 1, n_cols = trn.n_cols - 1;
  for (const GroundArea& area : areas)
    for (int row = 0; row < n_rows; ++row) {
      const double y = trn.node0.y() - (row + 0.5) * trn.cell_size;
      const std::vector<double> xs = crossings_at(area, y);
      for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
        const auto column = [&](double x) {  // first cell whose centre lies at or right of x
          const double place = std::ceil((x - trn.node0.x()) / trn.cell_size - 0.5);
          return static_cast<int>(std::clamp(place, 0.0, static_cast<double>(n_cols)));
        };
        const auto begin = classes.begin() + static_cast<std::ptrdiff_t>(row) * n_cols;
        std::fill(begin + column(xs[i]), begin + column(xs[i + 1]),
                  static_cast<std::uint8_t>(area.ground_class));
      }
    }
}

}  // namespace talus
