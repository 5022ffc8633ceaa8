// Lowest and highest elevation over any range of cells, by a pyramid of minima and maxima.
#include "terrain/trn_pyramid.hpp"

#include <algorithm>

namespace talus {
namespace {

void include(ElevationRange& range, const ElevationRange& other) {
  range.low = std::min(range.low, other.low);
  range.high = std::max(range.high, other.high);
  range.all_known &= other.all_known;
}

bool holds(const ElevationRange& range, const ElevationRange& other) {
  return other.low >= range.low && other.high <= range.high &&
         (other.all_known || !range.all_known);
}

// Corners of the cells of `range`, one by one. Summed up in registers, since for the compiler
// `found` might alias the elevations. One unknown elevation makes the sum of all of them NaN:
// cheaper than a test of each.
void include_nodes(const Trn& trn, const CellRange& range, ElevationRange& found) {
  double low = found.low, high = found.high, sum = 0;
  const double* z = trn.elevation.data() + node_index(trn, range.row_first, range.col_first);
  const int n_rows = range.row_last - range.row_first + 2;
  const int n_cols = range.col_last - range.col_first + 2;
  for (int row = 0; row < n_rows; ++row, z += trn.n_cols)
    for (int col = 0; col < n_cols; ++col) {
      low = z[col] < low ? z[col] : low;  // false for NaN
      high = z[col] > high ? z[col] : high;
      sum += z[col];
    }
  found = {low, high, found.all_known && !std::isnan(sum)};
}

CellRange intersection(const CellRange& a, const CellRange& b) {
  return {std::max(a.row_first, b.row_first), std::min(a.row_last, b.row_last),
          std::max(a.col_first, b.col_first), std::min(a.col_last, b.col_last)};
}

CellRange cells_of_tile(const Trn& trn, int level, int row, int col) {
  const int side = TrnPyramid::tile_cells << level;
  return {row * side, std::min((row + 1) * side, trn.n_rows - 1) - 1, col * side,
          std::min((col + 1) * side, trn.n_cols - 1) - 1};
}

void include_tile(const Trn& trn, const TrnPyramid& pyramid, const CellRange& range, int level,
                  int row, int col, ElevationRange& found) {
  const TrnPyramid::Level& tiles = pyramid.levels[level];
  if (row >= tiles.n_rows || col >= tiles.n_cols) return;
  const CellRange own = cells_of_tile(trn, level, row, col);
  const CellRange common = intersection(range, own);
  if (common.empty()) return;
  const ElevationRange& tile = tiles.tiles[row * tiles.n_cols + col];
  if (holds(found, tile)) return;
  if (common == own) {
    include(found, tile);
  } else if (level == 0) {
    include_nodes(trn, common, found);
  } else {
    for (const int part : {0, 1, 2, 3})
      include_tile(trn, pyramid, range, level - 1, 2 * row + part / 2, 2 * col + part % 2, found);
  }
}

TrnPyramid::Level first_level(const Trn& trn) {
  TrnPyramid::Level level;
  level.n_rows = (trn.n_rows - 2) / TrnPyramid::tile_cells + 1;
  level.n_cols = (trn.n_cols - 2) / TrnPyramid::tile_cells + 1;
  level.tiles.resize(static_cast<std::size_t>(level.n_rows) *
                     static_cast<std::size_t>(level.n_cols));
  auto tile = level.tiles.begin();
  for (int row = 0; row < level.n_rows; ++row)
    for (int col = 0; col < level.n_cols; ++col)
      include_nodes(trn, cells_of_tile(trn, 0, row, col), *tile++);
  return level;
}

TrnPyramid::Level next_level(const TrnPyramid::Level& finer) {
  TrnPyramid::Level level;
  level.n_rows = (finer.n_rows + 1) / 2;
  level.n_cols = (finer.n_cols + 1) / 2;
  level.tiles.resize(static_cast<std::size_t>(level.n_rows) *
                     static_cast<std::size_t>(level.n_cols));
  for (int row = 0; row < finer.n_rows; ++row)
    for (int col = 0; col < finer.n_cols; ++col)
      include(level.tiles[row / 2 * level.n_cols + col / 2], finer.tiles[row * finer.n_cols + col]);
  return level;
}

}  // namespace

TrnPyramid build_pyramid(const Trn& trn) {
  TrnPyramid pyramid;
  pyramid.levels.push_back(first_level(trn));
  while (pyramid.levels.back().tiles.size() > 1)
    pyramid.levels.push_back(next_level(pyramid.levels.back()));
  return pyramid;
}

ElevationRange elevation_range(const Trn& trn, const TrnPyramid& pyramid, const CellRange& range) {
  ElevationRange found;
  const int rows = range.row_last - range.row_first + 1;
  const int cols = range.col_last - range.col_first + 1;
  if (rows <= TrnPyramid::tile_cells && cols <= TrnPyramid::tile_cells)
    include_nodes(trn, range, found);
  else
    include_tile(trn, pyramid, range, static_cast<int>(pyramid.levels.size()) - 1, 0, 0, found);
  return found;
}

}  // namespace talus
