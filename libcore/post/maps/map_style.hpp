// libcore/post/maps/map_style.hpp: public
// Classes, colours and legends of the map layers.
#pragma once

#include "io/style.hpp"
#include "post/maps/maps.hpp"
#include "post/maps/ramp.hpp"

namespace talus {

/// The style of a layer. It shows the 95th percentile where nearly all cells that blocks came over
/// have one (19 of 20), else the maximum: a map must not leave out places that were reached. For
/// layers without percentiles it shows their main band. Energies break at 30 and 300 kJ, the limits
/// of low, medium and high intensity; zero is transparent. `remark`: the
/// style's own (e.g. that runs failed).
[[nodiscard]] RasterStyle map_style(const MapLayer& layer, const std::string& remark = {});

/// Words on a picture of a change: what changed, and what was taken from what.
struct ChangeWords {
  std::string heading, legend;
};
/// The style of a layer of differences (post/fence/fence_change.hpp, post/maps/compare.hpp): its
/// first band, blue for less and red for more, in classes up to `breaks`; changes below the first
/// of them are transparent. Where no change reaches the first, all breaks are ten, a hundred or a
/// thousand times smaller, so that pages of two measures may have different classes.
[[nodiscard]] RasterStyle change_style(const MapLayer& layer, const ChangeWords& words,
                                       const std::string& remark = {},
                                       const std::vector<double>& breaks = {0.05, 0.25, 0.5, 1, 2,
                                                                            4});

}  // namespace talus
