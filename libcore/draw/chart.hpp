// libcore/draw/chart.hpp: public
// Line charts: axes with round numbers, a legend.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "draw/drawing.hpp"

namespace talus {

/// One line; gaps where x or y is NaN (or not above 0 on a logarithmic axis).
struct ChartSeries {
  std::string name;    ///< in the legend; empty: none
  std::string colour;  ///< as colour_of() reads it
  std::vector<double> x, y;
  double width = 1.8;                   ///< of the stroke; 0: no line [px]
  double marker = 0;                    ///< radius of a circle at each point; 0: none [px]
  std::vector<double> y_high = {};      ///< a band from y up to it instead of a line; empty: none
  std::vector<std::string> notes = {};  ///< of the markers; empty: none
};

struct Chart {
  std::string title, x_label, y_label;
  std::vector<ChartSeries> series;
  bool log_y = false, log_x = false;
  double height = 300;         ///< [px]
  bool is_true_scale = false;  ///< x and y at one scale, whatever the height becomes
};

/// 640 px wide.
[[nodiscard]] Drawing chart_drawing(const Chart& chart);
/// As part of a page.
[[nodiscard]] inline std::string chart_svg(const Chart& chart) {
  return svg_of(chart_drawing(chart), "chart");
}
/// As a document.
[[nodiscard]] inline std::string chart_file(const Chart& chart) {
  return svg_of(chart_drawing(chart));
}

}  // namespace talus
