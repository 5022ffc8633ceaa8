// libcore/post/maps/maps.hpp: public
// Hazard maps: motion of blocks of one or many runs over each cell.
// in:    passages of runs by cell (map_rows.hpp)
// out:   bands over the cells that were touched; definitions in docs/reference/formats.md#maps
//
// A block counts once in a cell, with its largest value there. The rows of a cell are put in the
// order of run and block before anything is summed, so the same runs give the same bytes in
// whatever order they come. A map may be made in tiles, a range of cells at a time: then memory
// grows with the cells, and no longer with the runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/overview.hpp"
#include "post/maps/map_rows.hpp"
#include "post/share_interval.hpp"

namespace talus {

struct MapSettings {
  int min_passages = 0;  ///< for any percentile; 0: Wilks (5, 29, 59, 299 for p50 to p99)
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
  std::string name;                 ///< of the file, without extension; given by map_layers.hpp
  std::vector<std::uint32_t> cell;  ///< of each value, ascending       (n_touched)
  std::vector<MapBand> bands;
  bool is_codes = false;  ///< whole numbers 0 to 254 that are codes, not quantities
};

/// The five quantities whose per-block maxima are described by mean, percentiles, bounds, maximum.
enum class MapQuantity {
  speed,
  translational_energy,
  total_energy,
  centroid_height,
  top_height,
};

/// Mean, percentiles with bounds, and maximum; their names begin with that of the layer.
[[nodiscard]] MapLayer quantity_layer(const std::string& name, const CellRows& cells,
                                      MapQuantity quantity, const ShareBasis& basis,
                                      const MapSettings& settings);
/// n_pass, reach_probability and share of runs with bounds, passage_per_m, n_eff.
[[nodiscard]] MapLayer reach_layer(const CellRows& cells, double cell_size,
                                   const ShareBasis& basis);
/// The upper 95 % bound of the share of runs that come over a cell that none came over.
[[nodiscard]] double reach_bound_elsewhere(const ShareBasis& basis);
/// Shares of reach that are worth more runs [-].
inline constexpr double least_reach = 0.01;
/// Runs to add so that the interval of reach_probability is nowhere wider than 2 `half` where it is
/// above least_reach; 0: none, also where there are too few runs to tell. They help where they help
/// every such cell.
[[nodiscard]] RunsToAdd runs_to_add(const CellRows& cells, const ShareBasis& basis, double half);
/// p_exceed_30kJ, p_exceed_300kJ with bounds.
[[nodiscard]] MapLayer exceedance_layer(const CellRows& cells, const ShareBasis& basis);
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
