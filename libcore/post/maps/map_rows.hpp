// libcore/post/maps/map_rows.hpp
// Passages of runs brought to the cells of a map and put in order.
// in:    passages of runs on the grid they were recorded on
// out:   rows by cell, within a cell by run and block, so that sums do not depend on the order of
//        the files
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "record/passages.hpp"

namespace talus {

/// A passage with all that its cell's statistics need.
struct MapRow {
  std::uint32_t cell = 0;  ///< index in the map's grid
  std::int32_t run = 0;    ///< place of the run in the order of run ids
  std::int32_t block = 0;
  float weight = 1;
  PassageValues largest;
  float first_time = 0;    ///< [s]
  float travel_angle = 0;  ///< below the horizontal, from the start to here [rad]; NaN: no path
  float heading = 0;       ///< of the centroid when it came, from x to y [rad]; NaN: it was at rest
};

/// Width of a cell seen across a heading, in cell sizes; NaN: the mean over all directions.
[[nodiscard]] double cell_width_across(double heading);

/// Cells made of `factor` x `factor` cells of `recorded`, from the same north-west corner.
struct MapGrid {
  PassageGrid grid;
  int factor = 1;
};

/// The map's cells for a wanted size (NaN or 0: as recorded). Since all values are largest ones (or
/// first ones), cells of a whole multiple are exact. Throws InputError that names `item` for other
/// sizes.
[[nodiscard]] MapGrid map_grid(const PassageGrid& recorded, double cell_size,
                               const std::string& item);

/// Cells of the map from `first` to before `end`.
struct MapTile {
  std::uint32_t first = 0, end = std::numeric_limits<std::uint32_t>::max();
};

/// Rows of one run's passages over a tile, brought to the map's cells: one row per block and cell.
/// `weight`: of each block; empty: 1                                                 (n_blocks)
[[nodiscard]] std::vector<MapRow> map_rows(std::span<const Passage> passages,
                                           const PassageGrid& recorded, const MapGrid& map,
                                           std::span<const double> weight,
                                           const MapTile& tile = {});

/// Tiles that cover all cells, each with at most `most` rows, or a single cell. `rows_of_cell`: how
/// many rows each cell has                                                           (n_cells)
[[nodiscard]] std::vector<MapTile> tiles_of(std::span<const std::uint32_t> rows_of_cell,
                                            std::uint64_t most);

/// Rows by cell, ascending; within a cell by run and block.
struct CellRows {
  std::vector<std::uint32_t> cell;      ///< that were touched, ascending           (n_touched)
  std::vector<std::uint64_t> begin{0};  ///< rows of touched cell i: [i], [i + 1)   (n_touched + 1)
  std::vector<MapRow> rows;
};

/// `runs`: rows of each run, in the order of run ids; they are given that place. `n_cells`: of the
/// grid.
[[nodiscard]] CellRows group_by_cell(std::vector<std::vector<MapRow>> runs, std::size_t n_cells);

}  // namespace talus
