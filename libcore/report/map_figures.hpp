// libcore/report/map_figures.hpp: public
// The pictures of the map layers in a report, each with its caption and legend.
// in:    what talus-maps wrote beside each raster
// out:   HTML, in the order of the table of layers (post/maps/map_layers.hpp)
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace talus {

struct MapPicture {
  std::string name, png, qml;  ///< of maps/NAME.*; qml may be empty
};

/// One figure a layer that has a picture.
[[nodiscard]] std::string map_figures(const std::vector<MapPicture>& pictures);

/// Pictures of several cases, by the name of the case.
using CasePictures = std::vector<std::pair<std::string, std::vector<MapPicture>>>;
/// A row a layer that has a picture, the cases side by side; of the layers that decisions are made
/// by, or of all others.
[[nodiscard]] std::string case_figures(const CasePictures& cases, bool of_decisions);

}  // namespace talus
