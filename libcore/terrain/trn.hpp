// libcore/terrain/trn.hpp: public
// Terrain as a triangulated regular network (TRN): one elevation a node, two triangles a cell.
// in:    elevation raster written by talus-trn
// out:   cell, triangle, plane and elevation at a point, in a time that the size does not enter
// paper: Zhang et al. 2018, Sect. 3 (TRN)
//
// Row r counts southwards from the northernmost row, column c eastwards. Cell (r, c) has node (r,
// c) at its north-west corner and is cut along the diagonal (r, c) - (r + 1, c + 1), as in the
// paper. Triangles are never stored: triangle 2 [(n_cols - 1) r + c] is the lower left one,
// (r, c) (r + 1, c) (r + 1, c + 1), and the next, odd one the upper right,
// (r, c) (r + 1, c + 1) (r, c + 1); both counter-clockwise seen from above.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

namespace talus {

/// A dam or gallery in the ground: what the ground with it no longer says.
struct BurntDam {
  std::string name;           ///< of its section; of several lines with a point and a number
  int uphill = 1;             ///< +1: left of the line seen from its first point, -1: right
  std::vector<double> crest;  ///< its height at the points of the line, local z [m]
  std::vector<int> nodes;     ///< that it moved, ascending
  std::string shape;          ///< words of its line and all that shapes it
};

struct Trn {  // clang-format off
  int n_rows = 0;                 ///< nodes from north to south, the paper's m
  int n_cols = 0;                 ///< nodes from west to east, the paper's n
  double cell_size = 0;           ///< Delta, > 0 [m]
  Vec2 node0 = Vec2::Zero();      ///< local x, y of node (0, 0), the north-west one [m]
  Vec3 origin = Vec3::Zero();     ///< map coordinates of the local zero [m]
  std::string crs_wkt;            ///< projected, metres; empty when unknown
  std::vector<double> elevation;  ///< z at [r * n_cols + c] [m], NaN: unknown  (n_rows * n_cols)
  std::vector<BurntDam> dams;     ///< that talus-trn burnt into it
};  // clang-format on

/// A cell by the row and column of its north-west node.
struct Cell {
  int row = 0, col = 0;
  bool operator==(const Cell&) const = default;
};

/// A point in the plane as the grid sees it.
struct GridPoint {
  Cell cell;         ///< that holds the point; of the nearest border cell when it lies outside
  double east = 0;   ///< from the cell's west side, in cells; 0 to 1 inside [-]
  double south = 0;  ///< from the cell's north side, in cells; 0 to 1 inside [-]
};

/// The plane of a triangle: signed distance of x is normal.dot(x - point), > 0 above the ground.
struct TrianglePlane {
  Vec3 point;   ///< north-west node of the cell, a corner of both of its triangles [m]
  Vec3 normal;  ///< unit, upward
};

/// An edge of the network and the two triangles that meet at it, seen when walking from a to b.
struct TrnEdge {
  Cell a, b;      ///< its nodes by row and column
  int left = 0;   ///< triangle on the left
  int right = 0;  ///< triangle on the right
};

/// The three edges that node (r, c) owns: to (r, c + 1), to (r + 1, c), to (r + 1, c + 1).
enum class EdgeKind { east, south, diagonal };

/// Numbers of vertices, edges and faces of a terrain or of a block.
struct FeatureCounts {
  std::int64_t vertices = 0, edges = 0, faces = 0;
  bool operator==(const FeatureCounts&) const = default;
};

/// v_a = m n, e_a = (n - 1) m + (m - 1) n + (m - 1)(n - 1), f_a = 2 (m - 1)(n - 1).
[[nodiscard]] FeatureCounts feature_counts(const Trn& trn);

/// Throws InputError naming `file` unless the grid has at least 2 x 2 nodes, a positive finite cell
/// size, one elevation a node and at least one triangle of known ground.
void check_trn(const Trn& trn, const std::string& file);

// --- nodes -------------------------------------------------------------------------------------

[[nodiscard]] inline std::size_t node_index(const Trn& trn, int row, int col) {
  TALUS_ASSERT(row >= 0 && row < trn.n_rows && col >= 0 && col < trn.n_cols);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(trn.n_cols) +
         static_cast<std::size_t>(col);
}

/// Local position of a node; z is NaN where it is unknown [m].
[[nodiscard]] inline Vec3 node_point(const Trn& trn, int row, int col) {
  return {trn.node0.x() + col * trn.cell_size, trn.node0.y() - row * trn.cell_size,
          trn.elevation[node_index(trn, row, col)]};
}

// --- cells and triangles -----------------------------------------------------------------------

[[nodiscard]] inline int n_triangles(const Trn& trn) {
  return 2 * (trn.n_rows - 1) * (trn.n_cols - 1);
}

/// Whether (x, y) lies on the grid, its border included; false for NaN. Says nothing of nodata.
[[nodiscard]] inline bool contains(const Trn& trn, double x, double y) {
  const double east = (x - trn.node0.x()) / trn.cell_size;
  const double south = (trn.node0.y() - y) / trn.cell_size;
  return east >= 0 && south >= 0 && east <= trn.n_cols - 1 && south <= trn.n_rows - 1;
}

/// The cell of (x, y) and the place in it. Outside, the cell is that of the border and `east`,
/// `south` leave 0..1; NaN gives cell (0, 0). Clamping comes before the cast to int, which then is
/// the floor (the paper's INT gives cell 0 to a point just west of it) and costs nothing.
[[nodiscard]] inline GridPoint locate(const Trn& trn, double x, double y) {
  const auto clamped = [](double value, int last) {
    return static_cast<int>(value > 0 ? std::min(value, static_cast<double>(last)) : 0.0);
  };
  const double east = (x - trn.node0.x()) / trn.cell_size;
  const double south = (trn.node0.y() - y) / trn.cell_size;
  const Cell cell{clamped(south, trn.n_rows - 2), clamped(east, trn.n_cols - 2)};
  return {cell, east - cell.col, south - cell.row};
}

/// Index of the lower left triangle of a cell; the upper right one is the next.
[[nodiscard]] inline int first_triangle(const Trn& trn, const Cell& cell) {
  return 2 * ((trn.n_cols - 1) * cell.row + cell.col);
}

[[nodiscard]] inline Cell cell_of_triangle(const Trn& trn, int triangle) {
  return {triangle / 2 / (trn.n_cols - 1), triangle / 2 % (trn.n_cols - 1)};
}

/// Whether a place lies in the upper right triangle of its cell; the diagonal is the lower left's.
[[nodiscard]] inline bool is_upper(const GridPoint& point) { return point.south < point.east; }

[[nodiscard]] inline int triangle_of(const Trn& trn, const GridPoint& point) {
  return first_triangle(trn, point.cell) + (is_upper(point) ? 1 : 0);
}

/// The triangle above or below (x, y); that of the nearest border cell when the point lies outside.
[[nodiscard]] inline int triangle_at(const Trn& trn, double x, double y) {
  return triangle_of(trn, locate(trn, x, y));
}

/// Corners counter-clockwise seen from above; z is NaN where it is unknown [m].
[[nodiscard]] inline std::array<Vec3, 3> triangle_corners(const Trn& trn, int triangle) {
  const auto [r, c] = cell_of_triangle(trn, triangle);
  if (triangle % 2 == 0)
    return {node_point(trn, r, c), node_point(trn, r + 1, c), node_point(trn, r + 1, c + 1)};
  return {node_point(trn, r, c), node_point(trn, r + 1, c + 1), node_point(trn, r, c + 1)};
}

/// (dz/dx, dz/dy) of a cell's lower left or upper right triangle; NaN when a corner is unknown [-].
/// Walking north-west, middle, south-east corner, one of the two steps goes east, the other south;
/// written without a branch, which at random points would be mispredicted every second time.
[[nodiscard]] inline Vec2 triangle_gradient(const Trn& trn, const Cell& cell, bool upper) {
  const double* north = trn.elevation.data() + node_index(trn, cell.row, cell.col);
  const double* south = north + trn.n_cols;
  const double middle = *(upper ? north + 1 : south);
  const double first = middle - north[0], second = south[1] - middle;
  const double per_cell = 1 / trn.cell_size;
  return {(upper ? first : second) * per_cell, (upper ? -second : -first) * per_cell};
}

/// The same by the triangle's index.
[[nodiscard]] inline Vec2 triangle_gradient(const Trn& trn, int triangle) {
  return triangle_gradient(trn, cell_of_triangle(trn, triangle), triangle % 2 != 0);
}

/// Whether all three corners are known: a triangle with an unknown corner is not ground.
[[nodiscard]] inline bool is_known(const Trn& trn, int triangle) {
  const Vec2 gradient = triangle_gradient(trn, triangle);
  return !std::isnan(gradient.x()) && !std::isnan(gradient.y());
}

/// The plane through `point` that rises by `gradient`.
[[nodiscard]] inline TrianglePlane plane_of(const Vec3& point, const Vec2& gradient) {
  const double per_length = 1 / std::sqrt(1 + gradient.squaredNorm());
  return {point, Vec3(-gradient.x() * per_length, -gradient.y() * per_length, per_length)};
}

/// Plane of a cell's lower left or upper right triangle; NaN in point or normal when it is not
/// ground.
[[nodiscard]] inline TrianglePlane triangle_plane(const Trn& trn, const Cell& cell, bool upper) {
  return plane_of(node_point(trn, cell.row, cell.col), triangle_gradient(trn, cell, upper));
}

/// The same by the triangle's index.
[[nodiscard]] inline TrianglePlane triangle_plane(const Trn& trn, int triangle) {
  return triangle_plane(trn, cell_of_triangle(trn, triangle), triangle % 2 != 0);
}

/// Elevation of the ground at a place in its cell; NaN when its triangle is not ground [m].
[[nodiscard]] inline double elevation_at(const Trn& trn, const GridPoint& point) {
  const double* north = trn.elevation.data() + node_index(trn, point.cell.row, point.cell.col);
  const double* south = north + trn.n_cols;
  const double middle = *(is_upper(point) ? north + 1 : south);
  return north[0] + (middle - north[0]) * std::max(point.east, point.south) +
         (south[1] - middle) * std::min(point.east, point.south);
}

/// Elevation of the ground at local (x, y); NaN off the grid and where the triangle that holds the
/// point is not ground [m]. At a node the other terms vanish: its elevation, bit for bit,
/// unless the node lies in the last row or column.
[[nodiscard]] inline double elevation_at(const Trn& trn, double x, double y) {
  if (!contains(trn, x, y)) return std::numeric_limits<double>::quiet_NaN();
  return elevation_at(trn, locate(trn, x, y));
}

/// The edge of `kind` owned by node (row, col). Both of its triangles must exist: an east edge of
/// the first or last row and a south edge of the first or last column have only one.
[[nodiscard]] inline TrnEdge trn_edge(const Trn& trn, int row, int col, EdgeKind kind) {
  const int own = first_triangle(trn, {row, col});
  switch (kind) {
    case EdgeKind::east:
      return {{row, col}, {row, col + 1}, first_triangle(trn, {row - 1, col}), own + 1};
    case EdgeKind::south:
      return {{row, col}, {row + 1, col}, own, first_triangle(trn, {row, col - 1}) + 1};
    case EdgeKind::diagonal:
      break;
  }
  return {{row, col}, {row + 1, col + 1}, own + 1, own};
}

}  // namespace talus
