// libcore/report/map_legend.hpp
// The classes of a map in the page's own letters: those of a picture shrink with it.
// in:    a style as raster_qml() (io/style.hpp) writes it
// out:   HTML: a patch of colour and the label of each class that is drawn
#pragma once

#include <string>
#include <vector>

#include "io/style.hpp"
#include "report/texts.hpp"

namespace talus {

/// Band and classes of the style; no classes for an empty one.
[[nodiscard]] RasterStyle style_of(const std::string& qml);

/// Empty for a style without classes. `weak`: codes of classes that the map hatches in white;
/// `has_unsure`: it hatches cells in black.
[[nodiscard]] std::string html_legend(const Texts& texts, const std::string& qml,
                                      const std::vector<int>& weak = {}, bool has_unsure = false);

}  // namespace talus
