// Cells of a grid under a footprint, at rest and along a path.
#include "record/footprint_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "terrain/trn_walk.hpp"

namespace talus {
namespace {

// The axes along which footprints are measured.
struct Axes {
  AxisArray x, y;
  AxisArray half_cell;  // half the extent of a cell of size 1
  Axes() {
    for (int k = 0; k < n_footprint_axes; ++k) {
      const double angle = k * std::numbers::pi / n_footprint_axes;
      x[k] = std::cos(angle);
      y[k] = std::sin(angle);
    }
    x[n_footprint_axes / 2] = 0;  // not 6e-17: the axes along the grid are exact
    half_cell = 0.5 * (x.abs() + y.abs());
  }
  [[nodiscard]] AxisArray project(const Vec2& point) const { return point.x() * x + point.y() * y; }
};
const Axes axes;

struct CellBox {
  CellRange cells;    // clipped to the grid
  double margin = 0;  // from the extent's sides to the grid lines beyond [m]
};

// Cells below the box low..high (map orientation: x east, y north).
CellBox cells_below(const PassageGrid& grid, const Vec2& low, const Vec2& high) {
  const double west = (low.x() - grid.corner.x()) / grid.cell_size;
  const double east = (high.x() - grid.corner.x()) / grid.cell_size;
  const double north = (grid.corner.y() - high.y()) / grid.cell_size;
  const double south = (grid.corner.y() - low.y()) / grid.cell_size;
  CellBox box;
  const double inside = std::min({west - std::floor(west), std::ceil(east) - east,
                                  north - std::floor(north), std::ceil(south) - south});
  box.margin = inside * grid.cell_size;
  if (!(west < grid.n_cols && east > 0 && north < grid.n_rows && south > 0)) return box;
  const auto index = [](double value, int n) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, n - 1.0));
  };
  box.cells = {index(north, grid.n_rows), index(std::ceil(south) - 1, grid.n_rows),
               index(west, grid.n_cols), index(std::ceil(east) - 1, grid.n_cols)};
  return box;
}

// Cuts `share` down to where all of value + s * rate are positive.
void keep_positive(const AxisArray& value, const AxisArray& rate, PathShare& share) {
  const AxisArray zero = -value / rate;
  for (int k = 0; k < n_footprint_axes; ++k) {
    if (rate[k] > 0)
      share.in = std::max(share.in, zero[k]);
    else if (rate[k] < 0)
      share.out = std::min(share.out, zero[k]);
    else if (!(value[k] > 0))
      share.out = -1;
  }
}

}  // namespace

Extents footprint_extents(const Shapes& shapes, int block, const Quat& attitude) {
  const Mat3 turn = attitude.toRotationMatrix();
  Extents extents;
  extents.low.setConstant(std::numeric_limits<double>::infinity());
  extents.high.setConstant(-std::numeric_limits<double>::infinity());
  for (const Vec3& vertex : vertices_of(shapes, block)) {
    const AxisArray at = turn.row(0).dot(vertex) * axes.x + turn.row(1).dot(vertex) * axes.y;
    extents.low = extents.low.min(at);
    extents.high = extents.high.max(at);
  }
  return extents;
}

void find_covered(const PassageGrid& grid, const Footprint& footprint, PassageTracker& tracker) {
  const CellBox box = cells_below(grid, footprint.low(), footprint.high());
  const AxisArray place = axes.project(footprint.at), half = grid.cell_size * axes.half_cell;
  const AxisArray low = place + footprint.extents.low, high = place + footprint.extents.high;
  tracker.covered.clear();
  tracker.margin = box.margin;
  for (int row = box.cells.row_first; row <= box.cells.row_last; ++row)
    for (int col = box.cells.col_first; col <= box.cells.col_last; ++col) {
      const AxisArray centre = axes.project(cell_centre(grid, row, col));
      const double separation = (low - centre - half).max(centre - half - high).maxCoeff();
      tracker.margin = std::min(tracker.margin, std::abs(separation));
      if (separation < 0) tracker.covered.push_back(cell_index(grid, row, col));
    }
}

void find_covered(const PassageRecorder& recorder, const Vec2& at, PassageTracker& tracker) {
  tracker.covered.clear();
  tracker.margin = 0;
  walk_cells(recorder.frame, at, at, [&](const CellPart& part) {
    const Vec2 off = at - cell_centre(recorder.grid, part.cell.row, part.cell.col);
    tracker.covered.push_back(cell_index(recorder.grid, part.cell.row, part.cell.col));
    tracker.margin = std::max(0.0, 0.5 * recorder.grid.cell_size - off.cwiseAbs().maxCoeff());
  });
}

FootprintPath footprint_path(const PassageGrid& grid, const Footprint& from, const Footprint& to) {
  const AxisArray place = axes.project(from.at), rate = axes.project(to.at - from.at);
  FootprintPath path;
  path.cells =
      cells_below(grid, from.low().cwiseMin(to.low()), from.high().cwiseMax(to.high())).cells;
  path.low = place + from.extents.low;
  path.high = place + from.extents.high;
  path.low_rate = rate + to.extents.low - from.extents.low;
  path.high_rate = rate + to.extents.high - from.extents.high;
  path.half_cell = grid.cell_size * axes.half_cell;
  return path;
}

PathShare share_over_cell(const FootprintPath& path, const Vec2& centre) {
  const AxisArray at = axes.project(centre);
  PathShare share;
  keep_positive(path.high - at + path.half_cell, path.high_rate, share);
  if (share.in < share.out) keep_positive(at + path.half_cell - path.low, -path.low_rate, share);
  return share;
}

}  // namespace talus
