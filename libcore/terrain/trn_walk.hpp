// libcore/terrain/trn_walk.hpp: public
// The cells that a segment crosses in plan, in order, with the part of the segment in each.
// in:    two points; a TRN's grid
// out:   a call a cell; the parts follow one another without a gap, so that sums and maxima over
//        cells do not depend on how a path is cut into segments
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/trn.hpp"

namespace talus {

/// The part t_in..t_out (0 at the segment's start, 1 at its end) that lies over `cell`.
struct CellPart {
  Cell cell;
  double t_in = 0, t_out = 1;
};

/// One coordinate of a walk, in cells.
struct WalkAxis {
  int index;      ///< of the column or row that holds the current part
  int step;       ///< +1, -1, or 0 when the segment does not move along this axis
  double start;   ///< coordinate at t = 0
  double change;  ///< from t = 0 to 1
  double t_next;  ///< where the next grid line is crossed; infinity when step is 0

  WalkAxis(double from, double to)
      : index(0), step((to > from) - (to < from)), start(from), change(to - from), t_next(0) {}

  /// Parameter at which grid line k is met. At the far end k - start and change are the same
  /// number, so that a segment that ends on a line meets it at exactly 1 and never passes it.
  [[nodiscard]] double t_at(int line) const { return (line - start) / change; }

  /// Part of 0..1 inside the n cells of this axis; t_in > t_out when there is none.
  void clip(int n, double& t_in, double& t_out) const {
    if (step == 0) {
      if (!(start >= 0 && start <= n)) t_out = -1;
      return;
    }
    t_in = std::max(t_in, t_at(step > 0 ? 0 : n));
    t_out = std::min(t_out, t_at(step > 0 ? n : 0));
  }

  /// Set the cell that holds the part just after t. A segment along a grid line runs in the cell
  /// east or south of it, as in locate().
  void enter(int n, double t) {
    const double place = t > 0 ? start + t * change : start;
    double cell = std::floor(place);
    if (step < 0 && cell == place) cell -= 1;
    index = static_cast<int>(std::clamp(cell, 0.0, static_cast<double>(n - 1)));
    if (step != 0)  // rounding of `place` may leave a line ahead that was met at t already
      while (index + step >= 0 && index + step < n && t_at(line_ahead()) <= t) index += step;
    set_next();
  }

  void advance() {
    index += step;
    set_next();
  }

 private:
  [[nodiscard]] int line_ahead() const { return index + (step > 0); }
  void set_next() {
    t_next = step == 0 ? std::numeric_limits<double>::infinity() : t_at(line_ahead());
  }
};

/// Calls visit(CellPart) for each cell crossed by the segment from local (x, y) `a` to `b`, in
/// order. Every part has t_in < t_out: a corner that is only touched, or passed exactly, visits no
/// cell beside. A segment without extent in plan visits the cell of locate() once, with 0..1. Parts
/// off the grid are left out. Nodata is not looked at. Coordinates must be finite.
template <class Visit>
void walk_cells(const Trn& trn, const Vec2& a, const Vec2& b, Visit&& visit) {
  const int n_cols = trn.n_cols - 1, n_rows = trn.n_rows - 1;
  WalkAxis col((a.x() - trn.node0.x()) / trn.cell_size, (b.x() - trn.node0.x()) / trn.cell_size);
  WalkAxis row((trn.node0.y() - a.y()) / trn.cell_size, (trn.node0.y() - b.y()) / trn.cell_size);
  double t = 0, t_end = 1;
  col.clip(n_cols, t, t_end);
  row.clip(n_rows, t, t_end);
  if (!(t < t_end)) return;
  col.enter(n_cols, t);
  row.enter(n_rows, t);
  while (t < t_end) {
    const double t_out = std::min({col.t_next, row.t_next, t_end});
    if (t < t_out) visit(CellPart{{row.index, col.index}, t, t_out});
    t = t_out;
    if (col.t_next <= t) col.advance();
    if (row.t_next <= t) row.advance();
  }
}

}  // namespace talus
