// tests/paper/plot.hpp
// A figure of curves as SVG: axes with round ticks, lines or markers, a legend.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

struct Curve {
  std::string name;
  std::string colour;        ///< e.g. "#c1272d"
  std::vector<Vec2> points;  ///< x, y in the units of the axes
  bool markers = false;      ///< circles instead of a line
};

struct Figure {
  std::string title, x_label, y_label;  ///< labels carry the unit
  std::vector<Curve> curves;
  bool logarithmic_x = false;
};

/// The figure as one SVG document.
[[nodiscard]] std::string svg_of(const Figure& figure);

}  // namespace talus
