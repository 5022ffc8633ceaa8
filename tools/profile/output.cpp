// Crossings of a line and values along it, as tables, layers, charts, JSON and in words.
#include "tools/profile/output.hpp"

#include <algorithm>
#include <cmath>

#include "base/grouped_text.hpp"
#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "draw/chart.hpp"
#include "io/style.hpp"
#include "tools/frame/row_json.hpp"

namespace talus {
namespace {

constexpr double kilo = 1e3;

using Value = FieldValue;
constexpr FieldType words = FieldType::text, whole = FieldType::integer;

struct CrossingRow {
  const LineProfile& profile;
  const LineCrossing& c;
  [[nodiscard]] Vec3 place() const { return c.place + profile.origin; }
};
const std::vector<Field<CrossingRow>>& crossing_fields() {
  using Row = const CrossingRow&;
  static const std::vector<Field<CrossingRow>> fields = {
      {"run_id", "", "Run", [](Row r) -> Value { return r.profile.run_ids[r.c.at.run]; }, words},
      {"block", "", "Block", [](Row r) -> Value { return r.c.at.block; }, whole},
      {"method", "", "How it is known",
       [](Row r) -> Value { return r.c.by_cells ? "cells" : "frames"; }, words},
      {"time_s", "s", "Time", [](Row r) -> Value { return r.c.at.time; }},
      {"chainage_m", "m", "Place along the line", [](Row r) -> Value { return r.c.at.chainage; }},
      {"x_m", "m", "Centroid, x", [](Row r) -> Value { return r.place().x(); }},
      {"y_m", "m", "Centroid, y", [](Row r) -> Value { return r.place().y(); }},
      {"z_m", "m", "Centroid, elevation", [](Row r) -> Value { return r.place().z(); }},
      {"direction", "", "Direction: 1 to the left, -1 to the right",
       [](Row r) -> Value { return r.c.at.direction; }, whole},
      {"n_crossings", "", "Number of crossings", [](Row r) -> Value { return r.c.n_crossings; },
       whole},
      {"speed_m_s", "m/s", "Speed", [](Row r) -> Value { return r.c.at.speed; }},
      {"energy_kj", "kJ", "Kinetic energy, with spin",
       [](Row r) -> Value { return r.c.at.energy() / kilo; }},
      {"translational_energy_kj", "kJ", "Kinetic energy of translation",
       [](Row r) -> Value { return r.c.at.translation / kilo; }},
      {"rotational_energy_kj", "kJ", "Kinetic energy of rotation",
       [](Row r) -> Value { return r.c.at.rotation / kilo; }},
      {"energy_change_kj", "kJ", "Change of kinetic energy between the frames",
       [](Row r) -> Value { return r.c.energy_change / kilo; }},
      {"centroid_height_m", "m", "Height of the centroid above the ground",
       [](Row r) -> Value { return r.c.at.centroid; }},
      {"top_height_m", "m", "Height of the top above the ground",
       [](Row r) -> Value { return r.c.at.top; }},
      {"bottom_height_m", "m", "Height of the lowest point above the ground",
       [](Row r) -> Value { return r.c.at.bottom; }},
      {"mass_kg", "kg", "Mass", [](Row r) -> Value { return r.c.mass; }},
      {"volume_m3", "m3", "Volume", [](Row r) -> Value { return r.c.at.volume; }}};
  return fields;
}

const std::vector<Field<AcrossSummary>>& across_fields() {
  using Row = const AcrossSummary&;
  static const std::vector<Field<AcrossSummary>> fields = {
      {"from_m", "m", "From", [](Row r) -> Value { return r.from; }},
      {"to_m", "m", "To", [](Row r) -> Value { return r.to; }},
      {"n_crossings", "", "Number of crossings", [](Row r) -> Value { return r.blocks.n; }, whole},
      {"n_runs_hit", "", "Number of runs with a crossing",
       [](Row r) -> Value { return r.n_runs_hit; }, whole},
      {"share_of_runs", "", "Share of runs with a crossing",
       [](Row r) -> Value { return r.share_of_runs; }},
      {"share_of_runs_low", "", "Share of runs with a crossing, lower bound",
       [](Row r) -> Value { return r.interval_of_runs.low; }},
      {"share_of_runs_high", "", "Share of runs with a crossing, upper bound",
       [](Row r) -> Value { return r.interval_of_runs.high; }},
      {"blocks_a_run", "", "Blocks a run", [](Row r) -> Value { return r.a_run; }},
      {"share_of_blocks", "", "Share of blocks", [](Row r) -> Value { return r.share_of_blocks; }},
      {"share_of_blocks_low", "", "Share of blocks, lower bound",
       [](Row r) -> Value { return r.interval_of_blocks.low; }},
      {"share_of_blocks_high", "", "Share of blocks, upper bound",
       [](Row r) -> Value { return r.interval_of_blocks.high; }},
      {"mass_kg_a_run", "kg", "Mass a run", [](Row r) -> Value { return r.mass_a_run; }},
      {"share_of_mass", "", "Share of the mass", [](Row r) -> Value { return r.share_of_mass; }},
      {"first_arrival_s", "s", "First arrival", [](Row r) -> Value { return r.first_arrival; }},
      {"energy_p50_kj", "kJ", "Kinetic energy, median",
       [](Row r) -> Value { return r.blocks.energy.percentile[0].value / kilo; }},
      {"energy_p95_kj", "kJ", "Kinetic energy, 95th percentile",
       [](Row r) -> Value { return r.blocks.energy.percentile[place_of_p95].value / kilo; }},
      {"energy_p95_hi_kj", "kJ", "Kinetic energy, 95th percentile, upper bound",
       [](Row r) -> Value { return r.blocks.energy.percentile[place_of_p95].upper / kilo; }},
      {"energy_max_kj", "kJ", "Kinetic energy, largest",
       [](Row r) -> Value { return r.blocks.energy.largest / kilo; }},
      {"speed_p50_m_s", "m/s", "Speed, median",
       [](Row r) -> Value { return r.blocks.speed.percentile[0].value; }},
      {"speed_p95_m_s", "m/s", "Speed, 95th percentile",
       [](Row r) -> Value { return r.blocks.speed.percentile[place_of_p95].value; }},
      {"speed_p95_hi_m_s", "m/s", "Speed, 95th percentile, upper bound",
       [](Row r) -> Value { return r.blocks.speed.percentile[place_of_p95].upper; }},
      {"speed_max_m_s", "m/s", "Speed, largest",
       [](Row r) -> Value { return r.blocks.speed.largest; }},
      {"top_height_p50_m", "m", "Height of the top, median",
       [](Row r) -> Value { return r.blocks.top.percentile[0].value; }},
      {"top_height_p95_m", "m", "Height of the top, 95th percentile",
       [](Row r) -> Value { return r.blocks.top.percentile[place_of_p95].value; }},
      {"top_height_p95_hi_m", "m", "Height of the top, 95th percentile, upper bound",
       [](Row r) -> Value { return r.blocks.top.percentile[place_of_p95].upper; }},
      {"top_height_max_m", "m", "Height of the top, largest",
       [](Row r) -> Value { return r.blocks.top.largest; }}};
  return fields;
}

struct StationRow {
  const LineProfile& profile;
  const StationSummary& s;
  [[nodiscard]] Vec3 place() const { return s.place + profile.origin; }
};
const std::vector<Field<StationRow>>& station_fields() {
  using Row = const StationRow&;
  static const std::vector<Field<StationRow>> fields = {
      {"chainage_m", "m", "Place along the line", [](Row r) -> Value { return r.s.chainage; }},
      {"x_m", "m", "Place, x", [](Row r) -> Value { return r.place().x(); }},
      {"y_m", "m", "Place, y", [](Row r) -> Value { return r.place().y(); }},
      {"ground_m", "m", "Elevation of the ground", [](Row r) -> Value { return r.place().z(); }},
      {"n_blocks", "", "Number of blocks", [](Row r) -> Value { return r.s.n_blocks; }, whole},
      {"share_of_runs", "", "Share of runs", [](Row r) -> Value { return r.s.share_of_runs; }},
      {"energy_p50_kj", "kJ", "Kinetic energy, median",
       [](Row r) -> Value { return r.s.energy.p50 / kilo; }},
      {"energy_p95_kj", "kJ", "Kinetic energy, 95th percentile",
       [](Row r) -> Value { return r.s.energy.p95 / kilo; }},
      {"energy_max_kj", "kJ", "Kinetic energy, largest",
       [](Row r) -> Value { return r.s.energy.largest / kilo; }},
      {"speed_p50_m_s", "m/s", "Speed, median", [](Row r) -> Value { return r.s.speed.p50; }},
      {"speed_p95_m_s", "m/s", "Speed, 95th percentile",
       [](Row r) -> Value { return r.s.speed.p95; }},
      {"speed_max_m_s", "m/s", "Speed, largest", [](Row r) -> Value { return r.s.speed.largest; }},
      {"top_height_p50_m", "m", "Height of the top, median",
       [](Row r) -> Value { return r.s.top.p50; }},
      {"top_height_p95_m", "m", "Height of the top, 95th percentile",
       [](Row r) -> Value { return r.s.top.p95; }},
      {"top_height_max_m", "m", "Height of the top, largest",
       [](Row r) -> Value { return r.s.top.largest; }}};
  return fields;
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
  layer.fields = vector_fields(crossing_fields());
  for (const LineCrossing& crossing : profile.sums.crossings) {
    VectorFeature feature;
    feature.points = {crossing.place + profile.origin};
    feature.values = values_of(crossing_fields(), {profile, crossing});
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
  layer.fields = vector_fields(across_fields());
  for (const AcrossSummary& bin : profile.bins) {
    VectorFeature feature = piece_of(profile, bin.from, bin.to);
    feature.values = values_of(across_fields(), bin);
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
  layer.fields = vector_fields(station_fields());
  for (const StationSummary& station : profile.stations) {
    VectorFeature feature;
    feature.points = {station.place + profile.origin};
    feature.values = values_of(station_fields(), {profile, station});
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

// Only series with a value: an empty one would still be in the legend.
void add_series(Chart& chart, ChartSeries series) {
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
    if (std::isnan(s.top.largest)) tops.y[tops.y_high.size() - 1] = no_value;
  }
  add_series(chart, std::move(tops));
  add_series(chart, line_over(profile, "ground", "#5b4636", ground));
  add_series(chart, crossing_points(profile, "#cb181d", [](const LineCrossing& c) {
               return c.by_cells ? no_value : c.place.z() - c.at.centroid + c.at.top;
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
  add_series(chart, line_over(profile, "largest over each cell", "#3182bd", largest));
  add_series(chart, line_over(profile, "median over each cell", "#9ecae1", median));
  add_series(chart, crossing_points(profile, "#cb181d", of));
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
  std::string out = csv_row(names_of(crossing_fields()));
  for (const LineCrossing& c : profile.sums.crossings)
    out += csv_row(values_of(crossing_fields(), {profile, c}));
  return out;
}

std::string bin_csv(const LineProfile& profile) { return csv_of(across_fields(), profile.bins); }

std::string station_csv(const LineProfile& profile) {
  std::string out = csv_row(names_of(station_fields()));
  for (const StationSummary& station : profile.stations)
    out += csv_row(values_of(station_fields(), {profile, station}));
  return out;
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
  const Json bins = rows_json(across_fields(), profile.bins);
  Json stations = Json::array();
  for (const StationSummary& s : profile.stations)
    stations.push_back(row_json(station_fields(), {profile, s}));
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
            {"whole", row_json(across_fields(), profile.whole)},
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
