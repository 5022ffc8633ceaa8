// libcore/post/hazard/hazard_maps.hpp: public
// A slope's hazard as an authority asks for it: rate, intensity, class, and how sure these are.
// in:    rows of passages by cell, classes with frequencies, a recipe
// out:   layers over the cells that were touched
#pragma once

#include <string>
#include <vector>

#include "io/style.hpp"
#include "post/hazard/hazard_rates.hpp"
#include "post/maps/maps.hpp"
#include "post/maps/ramp.hpp"

namespace talus {

/// Sources of the layers.
struct HazardSources {
  std::vector<HazardRuns> classes;  ///< in the order of their runs
  Recipe recipe;
  bool has_frequencies = true;  ///< else only the shares of runs are made
};
[[nodiscard]] bool is_localized(const HazardSources& sources);

/// The layers of a range of cells, whose sorted rows these are; append() joins ranges.
///
/// event_exceed always. With frequencies: event_frequency, passage_frequency, return_period_* and
/// ke_T*; of a single failure instead probability. Then intensity, class and class_certain, of
/// codes, but not by a recipe of risk.
[[nodiscard]] std::vector<MapLayer> hazard_layers(const HazardSources& sources,
                                                  const std::vector<EventRow>& rows);

/// How a layer is drawn. `notes` are printed beside the map.
[[nodiscard]] RasterStyle hazard_style(const MapLayer& layer, const Recipe& recipe,
                                       const std::string& remark,
                                       const std::vector<std::string>& notes);

/// Symbols of polygons with a class, by field `code`, the worst first.
[[nodiscard]] VectorStyle class_style(const Recipe& recipe, double outline_mm,
                                      const std::string& label = "");

/// Classes with ascending limits; `is_deep_low`: small values are the bad ones.
[[nodiscard]] std::vector<StyleClass> stepped_classes(const std::vector<double>& limits,
                                                      const std::string& unit, bool is_deep_low,
                                                      Ramp ramp);

/// Of the classes of layers ke_T* and of areas of energy that are filed [kJ].
inline const std::vector<double> energy_limits = {3, 30, 100, 300, 1000, 3000, 10000};

/// Of the cells of layer "class": whether it is certain, its bounds, the number in the matrix.
inline constexpr const char* certainty_layer = "class_certain";

/// Each cell takes the class that most of the nine cells around it have, the worse of two, `times`
/// over: for outlines that are drawn, not for decisions.                    (n_rows x n_cols)
[[nodiscard]] std::vector<int> smoothed_classes(std::vector<int> codes, int n_rows, int n_cols,
                                                int times);

}  // namespace talus
