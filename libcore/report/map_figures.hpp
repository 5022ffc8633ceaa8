// libcore/report/map_figures.hpp: public
// The pictures of the map layers in a report, each with its caption and legend.
// in:    what talus-maps wrote beside each raster
// out:   HTML, in the order of the table of layers (post/maps/map_layers.hpp)
#pragma once

#include <string>
#include <vector>

namespace talus {

struct MapPicture {
  std::string name, png, qml;  ///< of maps/NAME.*; qml may be empty
};

/// One figure a layer that has a picture.
[[nodiscard]] std::string map_figures(const std::vector<MapPicture>& pictures);

}  // namespace talus
