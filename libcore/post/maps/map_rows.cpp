// Passages of runs brought to the cells of a map and put in order.
#include "post/maps/map_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

// The largest values of both; values of the arrival come from the earlier one.
void take_earlier(MapRow& row, const MapRow& other) {
  row.largest.raise(other.largest);
  if (other.first_time >= row.first_time) return;
  row.first_time = other.first_time;
  row.travel_angle = other.travel_angle;
  row.heading = other.heading;
}

// Rows of the same block and cell become one.
void merge_equal_cells(std::vector<MapRow>& rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const MapRow& a, const MapRow& b) {
    return a.block != b.block ? a.block < b.block : a.cell < b.cell;
  });
  std::size_t n = 0;
  for (const MapRow& row : rows) {
    if (n > 0 && rows[n - 1].block == row.block && rows[n - 1].cell == row.cell)
      take_earlier(rows[n - 1], row);
    else
      rows[n++] = row;
  }
  rows.resize(n);
}

MapRow map_row(const Passage& passage, std::uint32_t cell, float weight) {
  return {cell,
          0,
          passage.block,
          weight,
          passage.largest,
          passage.first_time,
          passage.travel_angle,
          passage.heading};
}

std::uint32_t map_cell(const Passage& passage, const PassageGrid& recorded, const MapGrid& map) {
  if (map.factor == 1) return static_cast<std::uint32_t>(passage.cell);
  const int row = passage.cell / recorded.n_cols / map.factor;
  const int col = passage.cell % recorded.n_cols / map.factor;
  return static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(map.grid.n_cols) +
         static_cast<std::uint32_t>(col);
}

// Counts, marks and sums of each cell, before there is any map.
MapGrid with_room(MapGrid map) {
  constexpr double bytes_per_cell = 24;
  require_memory(bytes_per_cell * map.grid.n_rows * map.grid.n_cols, {},
                 "maps of " + std::to_string(map.grid.n_cols) + " x " +
                     std::to_string(map.grid.n_rows) + " cells",
                 "make the cells larger (--cell-size-m)");
  return map;
}

}  // namespace

double cell_width_across(double heading) {
  if (std::isnan(heading)) return 4 / std::numbers::pi;
  return std::abs(std::cos(heading)) + std::abs(std::sin(heading));
}

MapGrid map_grid(const PassageGrid& recorded, double cell_size, const std::string& item) {
  if (std::isnan(cell_size) || cell_size == 0) return with_room({recorded, 1});
  const double ratio = cell_size / recorded.cell_size;
  const double factor = std::round(ratio);
  if (!(factor >= 1) || std::abs(ratio - factor) > 1e-9 * factor || factor > 1e6)
    throw InputError({"", 0, item},
                     "is " + text(cell_size) + ", expected a whole multiple of " +
                         text(recorded.cell_size) + ", the cells the passages were recorded on",
                     "other sizes would have to be resampled; set [output] cell_size_m = " +
                         text(cell_size) + " in the site file and run talus-dda again");
  const int k = static_cast<int>(factor);
  MapGrid map{recorded, k};
  map.grid.cell_size = recorded.cell_size * k;
  map.grid.n_rows = (recorded.n_rows + k - 1) / k;
  map.grid.n_cols = (recorded.n_cols + k - 1) / k;
  return with_room(map);
}

std::vector<MapRow> map_rows(std::span<const Passage> passages, const PassageGrid& recorded,
                             const MapGrid& map, std::span<const double> weight,
                             const MapTile& tile) {
  std::vector<MapRow> rows;
  rows.reserve(tile.first == 0 ? passages.size() : 0);
  for (const Passage& passage : passages) {
    const std::uint32_t cell = map_cell(passage, recorded, map);
    if (cell < tile.first || cell >= tile.end) continue;
    rows.push_back(
        map_row(passage, cell, weight.empty() ? 1 : static_cast<float>(weight[passage.block])));
  }
  if (map.factor > 1) merge_equal_cells(rows);
  return rows;
}

std::vector<MapTile> tiles_of(std::span<const std::uint32_t> rows_of_cell, std::uint64_t most) {
  std::vector<MapTile> tiles{{0, 0}};
  std::uint64_t n = 0;
  for (const std::uint32_t rows : rows_of_cell) {
    if (n + rows > most && tiles.back().end > tiles.back().first) {
      tiles.push_back({tiles.back().end, tiles.back().end});
      n = 0;
    }
    n += rows;
    ++tiles.back().end;
  }
  return tiles;
}

CellRows group_by_cell(std::vector<std::vector<MapRow>> runs, std::size_t n_cells) {
  // Counting sort: it keeps the order of runs and blocks within a cell.
  std::vector<std::uint64_t> place(n_cells + 1, 0);
  for (const auto& rows : runs)
    for (const MapRow& row : rows) ++place[row.cell + 1];
  CellRows cells;
  for (std::size_t cell = 0; cell < n_cells; ++cell) {
    if (place[cell + 1] > 0) {
      cells.cell.push_back(static_cast<std::uint32_t>(cell));
      cells.begin.push_back(cells.begin.back() + place[cell + 1]);
    }
    place[cell + 1] += place[cell];
  }
  cells.rows.resize(cells.begin.back());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    for (MapRow& row : runs[run]) {
      row.run = static_cast<std::int32_t>(run);
      cells.rows[place[row.cell]++] = row;
    }
    std::vector<MapRow>().swap(runs[run]);
  }
  return cells;
}

}  // namespace talus
