// libcore/report/map_figures.hpp: public
// The map layers in a report, each with its caption and legend.
// in:    the files that talus-maps wrote beside each raster
// out:   HTML, in the order of the table of layers (post/maps/map_layers.hpp)
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/map_sheet.hpp"
#include "report/texts.hpp"

namespace talus {

struct MapPicture {
  std::string name, qml;  ///< of maps/NAME.*
  CellPicture map;
  std::vector<int> weak = {};  ///< codes of classes that are hatched in white
};

/// One figure a layer that has a picture.
[[nodiscard]] std::string map_figures(const Texts& texts, const MapSheet& sheet,
                                      const std::vector<MapPicture>& pictures);
/// A figure with its legend; `caption` is HTML.
[[nodiscard]] std::string map_figure(const Texts& texts, const MapSheet& sheet,
                                     const MapPicture& picture, const std::string& alt,
                                     const std::string& unit, const std::string& caption);

/// Pictures of several cases, by the name of the case.
using CasePictures = std::vector<std::pair<std::string, std::vector<MapPicture>>>;
/// A row a layer that has a picture, the cases side by side; of the layers that decisions are made
/// by, or of all the rest.
[[nodiscard]] std::string case_figures(const Texts& texts, const MapSheet& sheet,
                                       const CasePictures& cases, bool of_decisions);

}  // namespace talus
