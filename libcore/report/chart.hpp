// libcore/report/chart.hpp: public
// Line charts as SVG, in a page or as a file: axes with round numbers, a legend, no script.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace talus {

/// One line; gaps where x or y is NaN (or not above 0 on a logarithmic axis).
struct ChartSeries {
  std::string name;    ///< in the legend; empty: none
  std::string colour;  ///< CSS
  std::vector<double> x, y;
  double width = 1.8;               ///< of the stroke; 0: no line [px]
  double marker = 0;                ///< radius of a circle at each point; 0: none [px]
  std::vector<double> y_high = {};  ///< a band from y up to it instead of a line; empty: none
};

struct Chart {
  std::string title, x_label, y_label;
  std::vector<ChartSeries> series;
  bool log_y = false, log_x = false;
};

/// Round numbers (1, 2 or 5 times a power of ten apart) that cover [low, high] with about `n`
/// steps.
[[nodiscard]] std::vector<double> round_ticks(double low, double high, int n);

/// 640 x 300 units; as wide as its place in the page.
[[nodiscard]] std::string chart_svg(const Chart& chart);
/// The same as a document of its own, with its styles.
[[nodiscard]] std::string chart_file(const Chart& chart);

}  // namespace talus
