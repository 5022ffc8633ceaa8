// libcore/terrain/grid_frame.hpp: public
// Where the nodes of a grid lie on the map: the frame of a raster before it becomes local ground.
#pragma once

#include <optional>

#include "terrain/trn.hpp"

namespace talus {

/// Nodes in rows from north to south and columns from west to east. For a raster, the nodes are the
/// centres of its cells.
struct GridFrame {
  int n_rows = 0, n_cols = 0;
  double cell_size = 0;            ///< distance of neighbouring nodes, > 0 [m]
  Vec2 north_west = Vec2::Zero();  ///< map coordinates of node (0, 0) [m]

  [[nodiscard]] double x(double col) const { return north_west.x() + col * cell_size; }
  [[nodiscard]] double y(double row) const { return north_west.y() - row * cell_size; }
  [[nodiscard]] bool empty() const { return n_rows < 1 || n_cols < 1; }
};

/// More nodes than a grid may have: 2 GB of elevations, and triangle indices stay within int.
inline constexpr std::int64_t largest_n_nodes = std::int64_t{1} << 28;

/// Throws InputError naming `file` when the frame has more nodes than that.
void check_size(const GridFrame& frame, const std::string& file);

/// A rectangle of the map [m].
struct MapWindow {
  double x_min = 0, y_min = 0, x_max = 0, y_max = 0;
};

/// From the first node to the last; no width when there is one node.
[[nodiscard]] MapWindow extent(const GridFrame& frame);

/// Common part; x_min > x_max or y_min > y_max when there is none.
[[nodiscard]] MapWindow intersection(const MapWindow& a, const MapWindow& b);

/// The window in another order of its numbers (xmin,xmax,ymin,ymax as QGIS writes an extent, or y
/// first) where it reaches beyond `data` as it is and lies mostly within it in that order; else
/// nothing.
[[nodiscard]] std::optional<MapWindow> other_order_within(const MapWindow& window,
                                                          const MapWindow& data);

/// Nodes at whole multiples of the cell size, so that grids of neighbouring windows fit together:
/// all that lie in `window`, its border included. Coordinates that are multiples but for rounding
/// (1e-6 of a cell) count as such. Throws InputError when there would be too many.
[[nodiscard]] GridFrame frame_inside(const MapWindow& window, double cell_size);

/// The same with one more row and column where needed, so that the nodes enclose `window`.
[[nodiscard]] GridFrame frame_covering(const MapWindow& window, double cell_size);

/// The smallest part of `frame` whose nodes enclose the common area of `window` and the frame's
/// extent; empty when they have no point in common.
[[nodiscard]] GridFrame part_covering(const GridFrame& frame, const MapWindow& window);

/// Whether cells of `cell_size` drift by less than 0.01 cell from those of `frame` over its extent:
/// then the user means the frame's own (4.99768 for 4.997678230579).
[[nodiscard]] bool is_own_cell_size(const GridFrame& frame, double cell_size);

/// Nodes at which the DEM `dem` can be known, inside `window` or just around it: the DEM's own
/// where the cell size is its own (or 0), else multiples of the cell size whose square
/// (RowResampler) lies on the DEM. Empty when the window misses the DEM.
[[nodiscard]] GridFrame frame_on_dem(const GridFrame& dem, double cell_size,
                                     const MapWindow& window);

/// A TRN on the nodes of `frame` from map elevations at [r * n_cols + c]. The local origin is the
/// south-west corner taken down to whole hundreds of metres; heights stay those of the map.
[[nodiscard]] Trn make_trn(const GridFrame& frame, std::string crs_wkt,
                           std::vector<double> elevation);

/// The frame of a TRN on the map.
[[nodiscard]] GridFrame frame_of(const Trn& trn);

}  // namespace talus
