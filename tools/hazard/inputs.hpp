// tools/hazard/inputs.hpp
// Inputs of talus-hazard: which runs are of which class, the recipe, the passages.
#pragma once

#include <string>
#include <vector>

#include "post/hazard/hazard_maps.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/site_options.hpp"

namespace talus {

/// All that the runs give, once they are read; rows as long as they are few enough.
struct HazardInputs {
  HazardSources sources;
  MapGrid map;                              ///< as recorded
  std::vector<std::uint32_t> rows_of_cell;  ///< of the map
  std::uint64_t n_rows = 0;
  std::vector<EventRow> rows;  ///< empty when they are more than `most_rows`
};
[[nodiscard]] HazardInputs read_hazard_inputs(RunInputs& runs,
                                              const std::vector<HazardClass>& classes,
                                              const Recipe& recipe, std::uint64_t most_rows);

/// The layers, tile by tile where the rows are too many.
[[nodiscard]] std::vector<MapLayer> read_hazard_layers(RunInputs& runs, HazardInputs& inputs,
                                                       std::uint64_t most_rows);

}  // namespace talus
