#include "tools/profile/output.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/csv.hpp"
#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "io/style.hpp"
#include "report/chart.hpp"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double kilo = 1e3;

// One value of a row: the same ones make tables, layers and JSON.
struct Column {
  std::string name;
  FieldValue value;
};
using Row = std::vector<Column>;

FieldValue whole(std::int64_t n) { return n; }

Row crossing_row(const LineProfile& profile, const LineCrossing& c) {
  const FenceArrival& at = c.at;
  const Vec3 place = c.place + profile.origin;
  return {{"run_id", profile.run_ids[at.run]},
          {"block", whole(at.block)},
          {"method", std::string(c.by_cells ? "cells" : "frames")},
          {"time_s", at.time},
          {"chainage_m", at.chainage},
          {"x_m", place.x()},
          {"y_m", place.y()},
          {"z_m", place.z()},
          {"direction", whole(at.direction)},
          {"n_crossings", whole(c.n_crossings)},
          {"speed_m_s", at.speed},
          {"energy_kj", at.energy() / kilo},
          {"translational_energy_kj", at.translation / kilo},
          {"rotational_energy_kj", at.rotation / kilo},
          {"energy_change_kj", c.energy_change / kilo},
          {"centroid_height_m", at.centroid},
          {"top_height_m", at.top},
          {"bottom_height_m", at.bottom},
          {"mass_kg", c.mass},
          {"volume_m3", at.volume}};
}

void add_quantity(Row& row, const std::string& name, const std::string& unit,
                  const QuantitySummary& quantity, double scale) {
  const auto& [p50, p90, p95, p99] = quantity.percentile;
  row.push_back({name + "_p50" + unit, p50.value / scale});
  row.push_back({name + "_p95" + unit, p95.value / scale});
  row.push_back({name + "_p95_hi" + unit, p95.upper / scale});
  row.push_back({name + "_max" + unit, quantity.largest / scale});
}

Row across_row(const AcrossSummary& s) {
  Row row = {{"from_m", s.from},
             {"to_m", s.to},
             {"n_crossings", whole(s.blocks.n)},
             {"n_runs_hit", whole(s.n_runs_hit)},
             {"share_of_runs", s.share_of_runs},
             {"share_of_runs_low", s.interval_of_runs.low},
             {"share_of_runs_high", s.interval_of_runs.high},
             {"blocks_a_run", s.a_run},
             {"share_of_blocks", s.share_of_blocks},
             {"share_of_blocks_low", s.interval_of_blocks.low},
             {"share_of_blocks_high", s.interval_of_blocks.high},
             {"mass_kg_a_run", s.mass_a_run},
             {"share_of_mass", s.share_of_mass},
             {"first_arrival_s", s.first_arrival}};
  add_quantity(row, "energy", "_kj", s.blocks.energy, kilo);
  add_quantity(row, "speed", "_m_s", s.blocks.speed, 1);
  add_quantity(row, "top_height", "_m", s.blocks.top, 1);
  return row;
}

void add_envelope(Row& row, const std::string& name, const std::string& unit, const Envelope& e,
                  double scale) {
  row.push_back({name + "_p50" + unit, e.p50 / scale});
  row.push_back({name + "_p95" + unit, e.p95 / scale});
  row.push_back({name + "_max" + unit, e.largest / scale});
}

Row station_row(const LineProfile& profile, const StationSummary& s) {
  const Vec3 place = s.place + profile.origin;
  Row row = {{"chainage_m", s.chainage},
             {"x_m", place.x()},
             {"y_m", place.y()},
             {"ground_m", place.z()},
             {"n_blocks", whole(s.n_blocks)},
             {"share_of_runs", s.share_of_runs}};
  add_envelope(row, "energy", "_kj", s.energy, kilo);
  add_envelope(row, "speed", "_m_s", s.speed, 1);
  add_envelope(row, "top_height", "_m", s.top, 1);
  return row;
}

std::string cell_text(const FieldValue& value) {
  if (const auto* n = std::get_if<std::int64_t>(&value)) return std::to_string(*n);
  if (const auto* words = std::get_if<std::string>(&value)) return *words;
  const double number = std::get<double>(value);
  return std::isfinite(number) ? text(number, 10) : "";
}

template <class Items, class RowOf>
std::string csv_of(const Items& items, const Row& names, RowOf&& row_of) {
  std::vector<std::string> line;
  for (const Column& column : names) line.push_back(column.name);
  std::string out = csv_line(line);
  for (const auto& item : items) {
    line.clear();
    for (const Column& column : row_of(item)) line.push_back(cell_text(column.value));
    out += csv_line(line);
  }
  return out;
}

Json json_of(const Row& row) {
  Json out = Json::object();
  for (const auto& [name, value] : row) {
    if (const auto* n = std::get_if<std::int64_t>(&value))
      out[name] = *n;
    else if (const auto* words = std::get_if<std::string>(&value))
      out[name] = *words;
    else
      out[name] = number_or_null(std::get<double>(value));
  }
  return out;
}

FieldType type_of(const FieldValue& value) {
  if (std::holds_alternative<std::int64_t>(value)) return FieldType::integer;
  return std::holds_alternative<std::string>(value) ? FieldType::text : FieldType::real;
}

void add_fields(VectorLayer& layer, const Row& names) {
  for (const Column& column : names) layer.fields.push_back({column.name, type_of(column.value)});
}

void add_values(VectorFeature& feature, const Row& row) {
  for (const Column& column : row) feature.values.push_back(column.value);
}

// The line between two chainages, with its stations.
VectorFeature piece_of(const LineProfile& profile, double from, double to) {
  const RecordLine& line = profile.sums.line;
  VectorFeature piece;
  const auto add = [&](double chainage) {
    piece.points.emplace_back(point_on(line, chainage) + profile.origin);
    piece.measure.push_back(chainage);
  };
  add(from);
  for (const double chainage : line.chainage)
    if (chainage > from && chainage < to) add(chainage);
  add(to);
  return piece;
}

VectorLayer crossing_layer(const LineProfile& profile) {
  VectorLayer layer{"crossings",
                    "where and how blocks first cross the line",
                    GeometryType::point_z,
                    {},
                    {},
                    vector_qml({SymbolKind::point,
                                "method",
                                {{"frames", "crosses, by frames", {227, 26, 28, 255}},
                                 {"cells", "comes over a cell of the line", {253, 191, 111, 255}}},
                                2})};
  add_fields(layer, crossing_row({{}, {}, {}, {}, {""}, {}}, {}));
  for (const LineCrossing& crossing : profile.sums.crossings) {
    VectorFeature feature;
    feature.points = {crossing.place + profile.origin};
    add_values(feature, crossing_row(profile, crossing));
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer bin_layer(const LineProfile& profile) {
  VectorLayer layer{"line_bins",
                    "what crosses each part of the line",
                    GeometryType::line_zm,
                    {},
                    {},
                    vector_qml({SymbolKind::line, "", {{"", "line", {31, 120, 180, 255}}}, 1})};
  add_fields(layer, across_row({}));
  for (const AcrossSummary& bin : profile.bins) {
    VectorFeature feature = piece_of(profile, bin.from, bin.to);
    add_values(feature, across_row(bin));
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

VectorLayer station_layer(const LineProfile& profile) {
  VectorLayer layer{"stations",
                    "ground along the line, and the largest values of blocks over its cells",
                    GeometryType::point_z,
                    {},
                    {},
                    vector_qml({SymbolKind::point, "", {{"", "station", {31, 120, 180, 255}}}, 1})};
  add_fields(layer, station_row(profile, {}));
  for (const StationSummary& station : profile.stations) {
    VectorFeature feature;
    feature.points = {station.place + profile.origin};
    add_values(feature, station_row(profile, station));
    layer.features.push_back(std::move(feature));
  }
  return layer;
}

constexpr const char* x_label = "along the line [m]";

ChartSeries line_over(const LineProfile& profile, const std::string& name, const char* colour,
                      double (*of)(const StationSummary&)) {
  ChartSeries series{name, colour, {}, {}};
  for (const StationSummary& station : profile.stations) {
    series.x.push_back(station.chainage);
    series.y.push_back(of(station));
  }
  return series;
}

// Nothing is drawn of it: all charts begin at 0 and show the whole line.
ChartSeries whole_line(const LineProfile& profile) {
  return {"", "none", {0, profile.sums.line.chainage.back()}, {0, 0}, 0};
}

bool has_values(const ChartSeries& series) {
  return std::any_of(series.y.begin(), series.y.end(), [](double y) { return std::isfinite(y); });
}

// Only what has any value: a chart of nothing would have a legend of nothing.
void add(Chart& chart, ChartSeries series) {
  if (has_values(series)) chart.series.push_back(std::move(series));
}

// A point a crossing.
ChartSeries crossing_points(const LineProfile& profile, const char* colour,
                            double (*of)(const LineCrossing&)) {
  const std::string method = profile.sums.n_by_frames > 0 ? "crossings" : "crossings, by cells";
  ChartSeries series{method, colour, {}, {}, 0, 2};
  for (const LineCrossing& crossing : profile.sums.crossings) {
    series.x.push_back(crossing.at.chainage);
    series.y.push_back(of(crossing));
  }
  return series;
}

std::string ground_chart(const LineProfile& profile) {
  Chart chart{
      "Ground along the line, and tops of the blocks that pass", x_label, "elevation [m]", {}};
  const auto ground = [](const StationSummary& s) { return s.place.z(); };
  ChartSeries tops = line_over(profile, "up to the highest top over each cell", "#fdbf6f", ground);
  for (const StationSummary& s : profile.stations) {
    tops.y_high.push_back(s.place.z() + s.top.largest);
    if (std::isnan(s.top.largest)) tops.y[tops.y_high.size() - 1] = none;
  }
  add(chart, std::move(tops));
  add(chart, line_over(profile, "ground", "#5b4636", ground));
  add(chart, crossing_points(profile, "#cb181d", [](const LineCrossing& c) {
        return c.by_cells ? none : c.place.z() - c.at.centroid + c.at.top;
      }));
  for (ChartSeries& series : chart.series)
    for (double& y : series.y) y += profile.origin.z();
  return chart_file(chart);
}

// Crossings as points, over the largest and the median of each block over each cell.
std::string quantity_chart(const LineProfile& profile, const std::string& title,
                           const std::string& y_label, double (*largest)(const StationSummary&),
                           double (*median)(const StationSummary&),
                           double (*of)(const LineCrossing&)) {
  Chart chart{title, x_label, y_label, {whole_line(profile)}};
  add(chart, line_over(profile, "largest over each cell", "#3182bd", largest));
  add(chart, line_over(profile, "median over each cell", "#9ecae1", median));
  add(chart, crossing_points(profile, "#cb181d", of));
  return chart_file(chart);
}

std::string count_chart(const LineProfile& profile) {
  Chart chart{"Blocks that cross each part of the line", x_label, "blocks a run", {}};
  ChartSeries steps{"", "#3182bd", {}, {}};
  for (const AcrossSummary& bin : profile.bins) {
    steps.x.insert(steps.x.end(), {bin.from, bin.from, bin.to, bin.to});
    steps.y.insert(steps.y.end(), {0, bin.a_run, bin.a_run, 0});
  }
  chart.series.push_back(std::move(steps));
  return chart_file(chart);
}

}  // namespace

std::string error_text(const LineSums& sums) {
  const EnergyChange change = energy_change(sums);
  std::string by_frames =
      "by frames " + text(sums.frame_interval, 3) + " s apart, linear between two";
  if (std::isfinite(change.p95))
    by_frames += "; energy changes between them by " + percent(change.p50) +
                 " in the median, 95 % by less than " + percent(change.p95) +
                 ", and nine in ten errors are smaller than that";
  const std::string by_cells =
      "by the cells under the line: upper bounds, each block with its largest values over these "
      "cells; none too few, a few per cent too many where blocks move on, many times too many "
      "where they come to rest at the line";
  if (sums.n_by_cells == 0) return by_frames;
  if (sums.n_by_frames == 0) return by_cells;
  return counted(sums.n_by_frames, "run") + " " + by_frames + "; " +
         counted(sums.n_by_cells, "run") + " " + by_cells;
}

std::string crossing_csv(const LineProfile& profile) {
  const LineProfile nothing{{}, {}, {}, {}, {""}, {}};
  return csv_of(profile.sums.crossings, crossing_row(nothing, {}),
                [&](const LineCrossing& c) { return crossing_row(profile, c); });
}

std::string bin_csv(const LineProfile& profile) {
  return csv_of(profile.bins, across_row({}), across_row);
}

std::string station_csv(const LineProfile& profile) {
  return csv_of(profile.stations, station_row(profile, {}),
                [&](const StationSummary& s) { return station_row(profile, s); });
}

std::vector<VectorLayer> profile_layers(const LineProfile& profile) {
  return {crossing_layer(profile), bin_layer(profile), station_layer(profile)};
}

std::vector<std::pair<std::string, std::string>> profile_charts(const LineProfile& profile) {
  using S = const StationSummary&;
  using C = const LineCrossing&;
  return {{"ground", ground_chart(profile)},
          {"count", count_chart(profile)},
          {"energy",
           quantity_chart(
               profile, "Energy of the blocks, with rotation", "energy [kJ]",
               [](S s) { return s.energy.largest / kilo; }, [](S s) { return s.energy.p50 / kilo; },
               [](C c) { return c.at.energy() / kilo; })},
          {"speed",
           quantity_chart(
               profile, "Speed of the blocks", "speed [m/s]", [](S s) { return s.speed.largest; },
               [](S s) { return s.speed.p50; }, [](C c) { return c.at.speed; })},
          {"height", quantity_chart(
                         profile, "Tops of the blocks above the ground", "height [m]",
                         [](S s) { return s.top.largest; }, [](S s) { return s.top.p50; },
                         [](C c) { return c.at.top; })}};
}

Json profile_json(const LineProfile& profile) {
  const LineSums& sums = profile.sums;
  Json bins = Json::array(), stations = Json::array();
  for (const AcrossSummary& bin : profile.bins) bins.push_back(json_of(across_row(bin)));
  for (const StationSummary& s : profile.stations)
    stations.push_back(json_of(station_row(profile, s)));
  const EnergyChange change = energy_change(sums);
  const bool has_frames = sums.n_by_frames > 0;
  return {{"line", {{"length_m", sums.line.chainage.back()}, {"n_stations", stations.size()}}},
          {"across",
           {{"method", method_text(sums)},
            {"error", error_text(sums)},
            {"n_runs_by_frames", sums.n_by_frames},
            {"n_runs_by_cells", sums.n_by_cells},
            {"frame_interval_s", has_frames ? Json(sums.frame_interval) : Json()},
            {"energy_change_p50", number_or_null(change.p50)},
            {"energy_change_p95", number_or_null(change.p95)},
            {"whole", json_of(across_row(profile.whole))},
            {"bins", bins}}},
          {"along",
           {{"method", sums.grid.n_rows > 0 ? "passages" : "ground alone"},
            {"n_runs", std::count(sums.has_passages.begin(), sums.has_passages.end(), true)},
            {"cell_size_m", sums.grid.n_rows > 0 ? Json(sums.grid.cell_size) : Json()},
            {"stations", stations}}}};
}

std::string profile_summary(const LineProfile& profile) {
  const AcrossSummary& s = profile.whole;
  std::string out = "line of " + text(s.to, 4) + " m: ";
  const int n = n_runs(profile.sums);
  if (s.blocks.n == 0)
    out += "nothing crosses it in " + counted(n, "run");
  else
    out += counted(s.blocks.n, "block") + (s.blocks.n == 1 ? " crosses" : " cross") + " it in " +
           std::to_string(s.n_runs_hit) + " of " + counted(n, "run");
  if (std::isfinite(s.interval_of_runs.high))
    out += " (95 %: " + text(s.interval_of_runs.low, 3) + " - " + text(s.interval_of_runs.high, 3) +
           ")";
  if (s.blocks.n > 0) {
    const auto p95 = [](const QuantitySummary& q, double scale, const std::string& unit) {
      const double value = q.percentile[place_of_p95].value;
      return (std::isnan(value) ? "" : "95 % below " + grouped_text(value / scale) + ", ") +
             "up to " + grouped_text(q.largest / scale) + " " + unit;
    };
    out += ", " + text(s.a_run, 3) + " a run, " + percent(s.share_of_mass) +
           " of the mass; energy " + p95(s.blocks.energy, kilo, "kJ") + "; speed " +
           p95(s.blocks.speed, 1, "m/s") + "; tops " + p95(s.blocks.top, 1, "m above the ground");
  }
  return out + "; by " + method_text(profile.sums);
}

}  // namespace talus
