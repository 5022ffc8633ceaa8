// libcore/report/map_legend.hpp
// The classes of a map in the page's own letters: those of a picture shrink with it.
// in:    a style as raster_qml() (io/style.hpp) writes it
// out:   HTML: a patch of colour and the label of each class that is drawn
#pragma once

#include <string>

#include "io/style.hpp"

namespace talus {

/// Band and classes of the style; no classes for an empty one.
[[nodiscard]] RasterStyle style_of(const std::string& qml);

/// Empty for a style without classes.
[[nodiscard]] std::string html_legend(const std::string& qml);

}  // namespace talus
