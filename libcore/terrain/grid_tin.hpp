// libcore/terrain/grid_tin.hpp: public
// A TIN on a regular grid of nodes: scan conversion, triangle by triangle.
// in:    a TIN, the nodes wanted
// out:   elevation of the TIN at each node, unknown outside of it: nothing is extrapolated
#pragma once

#include "base/progress.hpp"
#include "terrain/grid_frame.hpp"
#include "terrain/tin.hpp"

namespace talus {

/// Extent of the TIN's points on the map [m].
[[nodiscard]] MapWindow extent(const Tin& tin);

/// A cell size near the mean distance of the TIN's points, sqrt(area / n_points), taken down to 1,
/// 2 or 5 times a power of ten [m]; 0 when no triangle has an area in plan.
[[nodiscard]] double natural_cell_size(const Tin& tin);

/// Nodes inside two triangles that have two heights there: a surface in two layers.
struct TwoHeights {
  int n = 0;
  int row = 0, col = 0;     ///< of the first
  double z = 0, other = 0;  ///< there [m]
};

/// Elevation of the TIN at the nodes of `frame`, at [r * n_cols + c] [m], NaN outside of it.
///
/// Between the two crossings of a row of nodes with the edges of a triangle the elevation is
/// linear. The crossings of an edge are computed from the edge alone, so that the two triangles at
/// an edge leave no gap between them, and slender triangles cannot overshoot their corners by more
/// than rounding. A node on the border (to 1e-9 of a cell) is inside. Triangles without area in
/// plan are left out. `two`, if given, receives the nodes in two layers, 0.1 m apart and more.
[[nodiscard]] std::vector<double> grid_tin(const Tin& tin, const GridFrame& frame,
                                           const ProgressFunction& progress = {},
                                           TwoHeights* two = nullptr);

}  // namespace talus
