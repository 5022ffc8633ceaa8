// Charts of a run over time: speeds, paths, health, energy.
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

// At a time between two points; a series that has ended keeps its last value.
double value_at(const ChartSeries& line, double x) {
  const auto behind = std::upper_bound(line.x.begin(), line.x.end(), x);
  const auto i = static_cast<std::size_t>(behind - line.x.begin());
  if (i == 0) return line.y.front();
  if (i == line.x.size()) return line.y.back();
  const double share = (x - line.x[i - 1]) / (line.x[i] - line.x[i - 1]);
  return line.y[i - 1] + share * (line.y[i] - line.y[i - 1]);
}

// The median over the runs and all of them as a band, at the times of the run that lasted longest.
Chart as_band(const Texts& texts, Chart chart) {
  constexpr std::size_t most_points = 250;
  const ChartSeries& longest = *std::max_element(
      chart.series.begin(), chart.series.end(),
      [](const ChartSeries& a, const ChartSeries& b) { return a.x.back() < b.x.back(); });
  const std::size_t step = longest.x.size() / most_points + 1;
  ChartSeries band{texts.of("curves.band"), "#1f5fa8", {}, {}, 0};
  ChartSeries middle{texts.of("curves.median"), "#1f5fa8", {}, {}, 2.2};
  for (std::size_t i = 0; i < longest.x.size(); i += step) {
    std::vector<double> values;
    for (const ChartSeries& run : chart.series) values.push_back(value_at(run, longest.x[i]));
    std::sort(values.begin(), values.end());
    band.x.push_back(longest.x[i]);
    band.y.push_back(values.front());
    band.y_high.push_back(values.back());
    middle.x.push_back(longest.x[i]);
    const std::size_t half = values.size() / 2;
    middle.y.push_back(values.size() % 2 == 1 ? values[half]
                                              : (values[half - 1] + values[half]) / 2);
  }
  chart.series = {std::move(band), std::move(middle)};
  return chart;
}

}  // namespace

Chart curve_chart(const Texts& texts, const CsvTable& table, const std::string& column,
                  const std::string& title, const std::string& unit) {
  Chart chart{title, texts.of("curves.time"), unit, {}, false};
  std::map<std::string, std::size_t> place;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& run = table.at(row, "run_id");
    const auto [found, is_new] = place.emplace(run, chart.series.size());
    if (is_new) chart.series.push_back({"", run_colour(place.size() - 1), {}, {}, 1.4});
    chart.series[found->second].x.push_back(table.number(row, "time_s"));
    chart.series[found->second].y.push_back(table.number(row, column));
  }
  constexpr std::size_t least_for_a_band = 3;
  return chart.series.size() < least_for_a_band ? chart : as_band(texts, std::move(chart));
}

Chart health_chart(const Texts& texts, const std::vector<RunFile>& runs, const std::string& title,
                   const std::string& unit, double HealthRow::*field) {
  Chart chart{title, texts.of("curves.time"), unit, {}, true};
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

Chart energy_chart(const Texts& texts, const RunFile& run) {
  Chart chart{texts.of("health.energy"), texts.of("curves.time"), "MJ", {}, false};
  chart.series = {{texts.of("health.fallen"), "#1c2126", {}, {}},
                  {texts.of("health.moving"), "#1f5fa8", {}, {}},
                  {texts.of("health.friction"), "#c2491d", {}, {}},
                  {texts.of("health.impacts"), "#a8871c", {}, {}},
                  {texts.of("health.sum"), "#2f8a3c", {}, {}, 3.2}};
  if (run.health.empty()) return chart;
  const HealthRow& first = run.health.front();
  const double start = first.translation + first.rotation + first.potential + first.elastic +
                       spent_energy(first) - first.base - first.water;
  for (const HealthRow& row : run.health) {
    const double moving = row.translation + row.rotation + row.elastic;
    const double values[] = {start - row.potential + row.base + row.water, moving, row.friction,
                             row.impact, moving + spent_energy(row)};
    for (std::size_t k = 0; k < chart.series.size(); ++k) {
      chart.series[k].x.push_back(row.time);
      chart.series[k].y.push_back(values[k] / 1e6);
    }
  }
  std::rotate(chart.series.begin(), chart.series.end() - 1, chart.series.end());
  return chart;
}

}  // namespace talus
