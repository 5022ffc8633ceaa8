// libcore/terrain/trn_pyramid.hpp: public
// Lowest and highest elevation over any range of cells, and the candidate cells of a block.
// in:    a TRN; box of a block
// out:   the few cells that the block can touch in one step, or that it touches none
// paper: Zhang et al. 2018, Eq. (5)-(7)
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "terrain/trn.hpp"

namespace talus {

/// Cells row_first..row_last by col_first..col_last, ends included; empty when first > last.
struct CellRange {
  int row_first = 0, row_last = -1, col_first = 0, col_last = -1;
  [[nodiscard]] bool empty() const { return row_first > row_last || col_first > col_last; }
  bool operator==(const CellRange&) const = default;
};

/// Elevations over some nodes, unknown ones left out. Without a known node low > high.
struct ElevationRange {
  double low = std::numeric_limits<double>::infinity();    ///< [m]
  double high = -std::numeric_limits<double>::infinity();  ///< [m]
  bool all_known = true;                                   ///< no node was unknown
  bool operator==(const ElevationRange&) const = default;
};

/// Elevation ranges of square tiles, 8 x 8 cells in level 0, four tiles of a level in one of the
/// next, until one tile is left. Less than 0.4 byte a cell.
struct TrnPyramid {
  struct Level {
    int n_rows = 0, n_cols = 0;
    std::vector<ElevationRange> tiles;  ///< at [r * n_cols + c]            (n_rows * n_cols)
  };
  static constexpr int tile_cells = 8;  ///< cells along the side of a tile of level 0
  std::vector<Level> levels;            ///< build_pyramid
};

[[nodiscard]] TrnPyramid build_pyramid(const Trn& trn);

/// Range over all corners of the cells in `range`, exact, in a time that grows with the number of
/// nodes for a few cells and with the range's perimeter for many. `range` lies on the grid.
[[nodiscard]] ElevationRange elevation_range(const Trn& trn, const TrnPyramid& pyramid,
                                             const CellRange& range);

/// Cells whose triangles a box may touch within one step, Eq. (5a-d) and (6).
///
/// `ctol` is the largest vertex displacement in a step, >= 0 [m]. floor() replaces INT, which would
/// give cell 0 to a block just off the edge, and the grid's origin is subtracted. Clipped to the
/// grid; empty when the box misses it, or when a coordinate is NaN.
[[nodiscard]] inline CellRange cells_near(const Trn& trn, const Vec3& box_low, const Vec3& box_high,
                                          double ctol) {
  const double last_col = trn.n_cols - 2, last_row = trn.n_rows - 2;
  const double west = (box_low.x() - ctol - trn.node0.x()) / trn.cell_size;    // (5a)
  const double east = (box_high.x() + ctol - trn.node0.x()) / trn.cell_size;   // (5b)
  const double south = (trn.node0.y() - box_low.y() + ctol) / trn.cell_size;   // (5c)
  const double north = (trn.node0.y() - box_high.y() - ctol) / trn.cell_size;  // (5d)
  const bool touches = west <= last_col + 1 && east >= 0 && north <= last_row + 1 && south >= 0;
  if (!touches) return {};
  const auto index = [](double value, double last) {  // the cast is the floor: not below 0
    return static_cast<int>(std::clamp(value, 0.0, last));
  };
  return {index(north, last_row), index(south, last_row), index(west, last_col),
          index(east, last_col)};
}

/// Whether `holds` for the height of every node of `range` above the plane of the triangle of
/// `point` [m]; `holds` is false for NaN.
template <class Holds>
[[nodiscard]] bool all_nodes(const Trn& trn, const CellRange& range, const GridPoint& point,
                             const Holds& holds) {
  const Vec2 gradient = triangle_gradient(trn, point.cell, is_upper(point));
  const double per_col = gradient.x() * trn.cell_size, per_row = -gradient.y() * trn.cell_size;
  const double at_point = trn.elevation[node_index(trn, point.cell.row, point.cell.col)];
  for (int row = range.row_first; row <= range.row_last + 1; ++row) {
    const double* z = trn.elevation.data() + node_index(trn, row, 0);
    const double start = at_point + (row - point.cell.row) * per_row - point.cell.col * per_col;
    bool all = true;  // of the whole row, so that several nodes are looked at in one go
    for (int col = range.col_first; col <= range.col_last + 1; ++col)
      all &= holds(z[col] - (start + col * per_col));
    if (!all) return false;
  }
  return true;
}

/// So near to a plane a node lies in it, as a part of the cell size.
inline constexpr double flat_ratio = 1e-9;

/// Whether all nodes of `range` lie in the plane of the triangle of `point`; false when one is
/// unknown.
[[nodiscard]] inline bool is_plane(const Trn& trn, const CellRange& range, const GridPoint& point) {
  const double flat = flat_ratio * trn.cell_size;
  return all_nodes(trn, range, point, [flat](double height) { return std::abs(height) <= flat; });
}

/// Whether no node of `range` lies above the plane of the triangle of `point`; false when one is
/// unknown.
[[nodiscard]] inline bool is_below(const Trn& trn, const CellRange& range, const GridPoint& point) {
  const double flat = flat_ratio * trn.cell_size;
  return all_nodes(trn, range, point, [flat](double height) { return height <= flat; });
}

/// Position of a block relative to the ground of its candidate cells.
enum class Reach {
  off_ground,  ///< the box misses the grid, or nothing is known below it: the block left the domain
  above,       ///< Eq. (7): no contact in this step
  possible,    ///< the cells have to be looked at
  below,       ///< under the lowest ground: the block fell through, which is an error
};

struct NearCells {
  CellRange cells;
  ElevationRange ground;  ///< over the corners of `cells`
  Reach reach = Reach::off_ground;
};

/// Candidate cells of a box with Eq. (7), z_min - ctol >= Z_max: above; and z_max + ctol < Z_min.
[[nodiscard]] inline NearCells find_near_cells(const Trn& trn, const TrnPyramid& pyramid,
                                               const Vec3& box_low, const Vec3& box_high,
                                               double ctol) {
  NearCells near;
  near.cells = cells_near(trn, box_low, box_high, ctol);
  if (near.cells.empty()) return near;
  near.ground = elevation_range(trn, pyramid, near.cells);
  if (near.ground.low > near.ground.high) return near;
  if (box_low.z() - ctol >= near.ground.high)
    near.reach = Reach::above;
  else
    near.reach = box_high.z() + ctol < near.ground.low ? Reach::below : Reach::possible;
  return near;
}

}  // namespace talus
