#include "report/run_charts.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace talus {
namespace {

std::string run_colour(std::size_t i) {
  static const char* const colours[] = {"#1f5fa8", "#c2491d", "#2f8a3c", "#7a4fa3",
                                        "#a8871c", "#1b8b8b", "#b03a73", "#5b6570"};
  return colours[i % 8];
}

}  // namespace

Chart curve_chart(const CsvTable& table, const std::string& column, const std::string& title,
                  const std::string& unit) {
  Chart chart{title, "time [s]", unit, {}, false};
  std::map<std::string, std::size_t> place;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& run = table.at(row, "run_id");
    const auto [found, is_new] = place.emplace(run, chart.series.size());
    if (is_new) chart.series.push_back({"", run_colour(place.size() - 1), {}, {}, 1.4});
    chart.series[found->second].x.push_back(table.number(row, "time_s"));
    chart.series[found->second].y.push_back(table.number(row, column));
  }
  return chart;
}

Chart health_chart(const std::vector<RunFile>& runs, const std::string& title,
                   const std::string& unit, double HealthRow::*field) {
  Chart chart{title, "time [s]", unit, {}, true};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    ChartSeries line{"", run_colour(i), {}, {}, 1.4};
    for (const HealthRow& row : runs[i].health) {
      line.x.push_back(row.time);
      line.y.push_back(row.*field);
    }
    chart.series.push_back(std::move(line));
  }
  return chart;
}

Chart energy_chart(const RunFile& run) {
  Chart chart{"Energy balance", "time [s]", "MJ", {}, false};
  chart.series = {{"fallen", "#1c2126", {}, {}},
                  {"moving", "#1f5fa8", {}, {}},
                  {"friction", "#c2491d", {}, {}},
                  {"impacts", "#a8871c", {}, {}},
                  {"sum", "#2f8a3c", {}, {}, 3.2}};
  if (run.health.empty()) return chart;
  const HealthRow& first = run.health.front();
  const double start = first.translation + first.rotation + first.potential + first.elastic +
                       first.friction + first.impact + first.contact + first.rolling + first.drag +
                       first.breakage + first.removed - first.base;
  for (const HealthRow& row : run.health) {
    const double moving = row.translation + row.rotation + row.elastic;
    const double spent = row.friction + row.impact + row.contact + row.rolling + row.drag +
                         row.breakage + row.removed;
    const double values[] = {start - row.potential + row.base, moving, row.friction, row.impact,
                             moving + spent};
    for (std::size_t k = 0; k < chart.series.size(); ++k) {
      chart.series[k].x.push_back(row.time);
      chart.series[k].y.push_back(values[k] / 1e6);
    }
  }
  std::rotate(chart.series.begin(), chart.series.end() - 1, chart.series.end());
  return chart;
}

}  // namespace talus
