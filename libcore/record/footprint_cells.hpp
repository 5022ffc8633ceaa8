// libcore/record/footprint_cells.hpp
// The cells of a grid that a footprint lies over, at one place and on its path to another.
// in:    footprints as extents along eight axes (record/passage_recorder.hpp)
// out:   cells; on a path the part of it over each, in closed form
#pragma once

#include "contact/shapes.hpp"
#include "record/passage_recorder.hpp"
#include "terrain/trn_pyramid.hpp"

namespace talus {

/// A footprint at one place.
struct Footprint {
  Vec2 at;  ///< of the centroid, x to the east, y to the north [m]
  Extents extents;
  [[nodiscard]] Vec2 low() const {
    return at + Vec2(extents.low[0], extents.low[n_footprint_axes / 2]);
  }
  [[nodiscard]] Vec2 high() const {
    return at + Vec2(extents.high[0], extents.high[n_footprint_axes / 2]);
  }
};

/// Of the vertices of a block.
[[nodiscard]] Extents footprint_extents(const Shapes& shapes, int block, const Quat& attitude);

[[nodiscard]] inline int cell_index(const PassageGrid& grid, int row, int col) {
  return row * grid.n_cols + col;
}
[[nodiscard]] inline Vec2 cell_centre(const PassageGrid& grid, int row, int col) {
  return grid.corner + grid.cell_size * Vec2(col + 0.5, -row - 0.5);
}

/// Sets the tracker's covered cells, those below the footprint, and its margin: how far the
/// footprint's points may move before they change.
void find_covered(const PassageGrid& grid, const Footprint& footprint, PassageTracker& tracker);
/// The same for the centroid alone, which a grid line puts into the cell east or south of it.
void find_covered(const PassageRecorder& recorder, const Vec2& at, PassageTracker& tracker);

/// A footprint that goes straight from one place to another, its extents linearly.
struct FootprintPath {
  CellRange cells;                ///< that it may lie over
  AxisArray low, high;            ///< its sides at the start, along the axes [m]
  AxisArray low_rate, high_rate;  ///< by which they move up to the end [m]
  AxisArray half_cell;            ///< half the extent of a cell [m]
};
[[nodiscard]] FootprintPath footprint_path(const PassageGrid& grid, const Footprint& from,
                                           const Footprint& to);

/// A part of a path, which goes from 0 to 1; none when in >= out.
struct PathShare {
  double in = 0, out = 1;
};
/// The part with the footprint over a cell: while their extents overlap along each axis.
[[nodiscard]] PathShare share_over_cell(const FootprintPath& path, const Vec2& centre);

/// Calls visit(cell, in, out) for every cell that the footprint lies over on its path.
template <class Visit>
void sweep_cells(const PassageGrid& grid, const Footprint& from, const Footprint& to,
                 Visit&& visit) {
  const FootprintPath path = footprint_path(grid, from, to);
  for (int row = path.cells.row_first; row <= path.cells.row_last; ++row)
    for (int col = path.cells.col_first; col <= path.cells.col_last; ++col) {
      const PathShare share = share_over_cell(path, cell_centre(grid, row, col));
      if (share.in < share.out) visit(cell_index(grid, row, col), share.in, share.out);
    }
}

}  // namespace talus
