// tools/frame/factor_chart.hpp
// Factor of safety against the height of the water, as talus-stability found it.
#pragma once

#include <limits>
#include <string>

#include "draw/chart.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

struct FactorChartWords {
  std::string title, water, factor, mass, first, fails_below;
};

/// `stability`: the content of stability.json.
[[nodiscard]] inline Chart factor_chart(const Json& stability, const FactorChartWords& words) {
  Chart chart{words.title,
              words.water,
              words.factor,
              {{words.mass, "#1f5fa8", {}, {}, 1.8, 3},
               {words.first, "#c2491d", {}, {}, 1.8, 3},
               {words.fails_below, "#808080", {}, {}, 1}}};
  const auto number = [](const Json& x) {
    return x.is_number() ? x.get<double>() : std::numeric_limits<double>::quiet_NaN();
  };
  for (const Json& level : stability.at("levels")) {
    for (ChartSeries& series : chart.series) series.x.push_back(number(level.at("water_m")));
    chart.series[0].y.push_back(number(level.at("mass").at("factor")));
    chart.series[1].y.push_back(number(level.at("first").at("factor")));
    chart.series[2].y.push_back(1);
  }
  return chart;
}

}  // namespace talus
