// libcore/post/maps.hpp
// Hazard maps: what blocks of one or many runs did over each cell.
// in:    passages of runs (one row per block and cell, the largest values while over it)
// out:   bands over the cells that were touched; definitions in docs/formats.md#maps
//
// A block counts once in a cell, with its largest value there. The rows of a cell are put in the
// order of run and block before anything is summed, so the same runs give the same bytes in
// whatever order they come. A map may be made in tiles, a range of cells at a time: then memory
// grows with the cells, and no longer with the runs.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "io/overview.hpp"
#include "store/passages.hpp"

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
  float heading = 0;       ///< of the centroid when it came, from x to y [rad]; NaN: it stood
};

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

/// What was released: the denominators.
struct Released {
  std::vector<double> weight;  ///< sum over the run's blocks                       (n_runs)
  std::vector<int> n_blocks;   ///<                                                 (n_runs)
};

struct MapSettings {
  int min_passages = 0;    ///< for any percentile; 0: Wilks (5, 29, 59, 299 for p50 to p99)
  int n_resamples = 200;   ///< of the runs
  std::uint64_t seed = 1;  ///< of the bootstrap
};

/// One quantity over the touched cells; NaN = nodata.
struct MapBand {
  std::string name, unit, description;
  bool zero_elsewhere = false;  ///< cells that nothing touched hold 0 (else nodata)
  std::vector<float> value;     ///<                                                (n_touched)
  OverviewValue overview = OverviewValue::largest;  ///< in the file
};

/// Bands that share a file.
struct MapLayer {
  std::string name;  ///< of the file, without extension
  std::string title;
  std::vector<std::uint32_t> cell;  ///< that the values stand for, ascending       (n_touched)
  std::vector<MapBand> bands;
};

/// The five quantities whose per-block maxima are described by mean, percentiles, bounds, maximum.
enum class MapQuantity {
  speed,
  translational_energy,
  total_energy,
  centroid_height,
  top_height,
};
inline constexpr std::array map_quantities = {
    MapQuantity::speed, MapQuantity::translational_energy, MapQuantity::total_energy,
    MapQuantity::centroid_height, MapQuantity::top_height};

/// Layers velocity, ke_translational, ke_total, pass_height_centroid, pass_height_top.
[[nodiscard]] MapLayer quantity_layer(const CellRows& cells, MapQuantity quantity,
                                      const Released& released, const MapSettings& settings);
/// n_pass, reach_probability with bounds, share of runs, passage_per_m, n_eff.
[[nodiscard]] MapLayer reach_layer(const CellRows& cells, double cell_size,
                                   const Released& released, const MapSettings& settings);
/// p_exceed_30kJ, p_exceed_300kJ.
[[nodiscard]] MapLayer exceedance_layer(const CellRows& cells, const Released& released);
/// first_arrival.
[[nodiscard]] MapLayer arrival_layer(const CellRows& cells);
/// energy_line_angle.
[[nodiscard]] MapLayer energy_line_layer(const CellRows& cells);

/// Adds the cells of a layer that follow on those of `layer`: another tile of the same map.
void append(MapLayer& layer, const MapLayer& next);

/// A band over all cells of the grid, `nodata` where it has no value.
[[nodiscard]] std::vector<float> on_grid(const MapLayer& layer, const MapBand& band,
                                         std::size_t n_cells, float nodata);

}  // namespace talus
