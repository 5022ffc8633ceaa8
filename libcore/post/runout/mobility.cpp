// Volume, fall height and run-out of an event beside published relations.
#include "post/runout/mobility.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/percentile.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "sampling/normal.hpp"

namespace talus {
namespace {

constexpr double lower_line_sd = 1.6449;  // 5 % of a normal scatter lie farther below

MobilityKind kind_of(const CsvTable& table, std::size_t row) {
  const std::string& word = table.at(row, "kind");
  if (word == "hl_power") return MobilityKind::hl_power;
  if (word == "length") return MobilityKind::length;
  if (word == "angle") return MobilityKind::angle;
  throw InputError({table.file, table.line[row]},
                   "kind is \"" + word + "\", expected hl_power, length or angle");
}

double needed(const CsvTable& table, std::size_t row, const char* name) {
  const double value = table.number(row, name);
  if (std::isnan(value))
    throw InputError({table.file, table.line[row]}, std::string(name) + " is missing");
  return value;
}

// --- the chart ---------------------------------------------------------------------------------

constexpr double log_v_high = 9, hl_low = 0.05, hl_high = 2.5;  // of the axes; volumes from 1 m3

// The relations of the chart: one a kind of event, of all paths, read in print.
struct Charted {
  const char* id;
  const char* words;
  const char* colour;
};
constexpr std::array charted = {
    Charted{"corominas_rockfall_all", "rockfalls (Corominas 1996)", "#c8553d"},
    Charted{"corominas_slide_all", "translational slides (Corominas 1996)", "#1b6ca8"},
    Charted{"mitchell_hl", "rock avalanches (Mitchell et al. 2019)", "#3a7d44"}};

// A relation inside the axes.
ChartSeries relation_line(const MobilityRelation& r, const Charted& shown) {
  ChartSeries line{shown.words, shown.colour, {}, {}, 2};
  constexpr int n = 180;
  for (int i = 0; i <= n; ++i) {
    const double log_v = log_v_high * i / n, hl = std::pow(10, r.a + r.b * log_v);
    line.x.push_back(std::pow(10, log_v));
    line.y.push_back(hl < hl_low || hl > hl_high ? no_value : hl);
  }
  return line;
}

// Between a relation and its lower 95 % line, inside the axes.
ChartSeries band_below(const MobilityRelation& r, const Charted& shown) {
  ChartSeries band{"slides down to their lower 95 % line", shown.colour, {}, {}, 0};
  constexpr int n = 36;  // points: a line that leaves the axes bends there
  for (int i = 0; i <= n; ++i) {
    const double log_v = log_v_high * i / n;
    band.x.push_back(std::pow(10, log_v));
    band.y.push_back(std::clamp(std::pow(10, r.a - r.lower + r.b * log_v), hl_low, hl_high));
    band.y_high.push_back(std::clamp(std::pow(10, r.a + r.b * log_v), hl_low, hl_high));
  }
  return band;
}

}  // namespace

std::vector<MobilityRelation> mobility_relations(const CsvTable& table) {
  std::vector<MobilityRelation> relations;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    MobilityRelation r;
    r.id = table.at(row, "id");
    r.group = table.at(row, "group");
    r.path = table.at(row, "path");
    r.kind = kind_of(table, row);
    r.a = needed(table, row, "a");
    r.b = r.kind == MobilityKind::angle ? no_value : needed(table, row, "b");
    r.c = r.kind == MobilityKind::length ? needed(table, row, "c") : no_value;
    r.d = r.kind == MobilityKind::length ? needed(table, row, "d") : no_value;
    r.lower = table.number(row, "lower");
    r.n = table.number(row, "n");
    r.sd = table.number(row, "sd");
    if (std::isnan(r.sd)) r.sd = r.lower / lower_line_sd;
    r.from_memory = table.at(row, "mark") == "m";
    r.source = table.at(row, "source");
    relations.push_back(std::move(r));
  }
  return relations;
}

MobilityRow compare(const MobilityRelation& r, const MobilityEvent& event) {
  MobilityRow row{no_value, no_value, no_value, no_value};
  if (!(event.volume > 0 && event.height > 0 && event.length > 0)) return row;
  const double log_v = std::log10(event.volume), log_h = std::log10(event.height);
  const double log_l = std::log10(event.length);
  switch (r.kind) {
    case MobilityKind::hl_power: {
      const double log_hl = r.a + r.b * log_v;
      row.length = std::pow(10, log_h - log_hl);
      row.length_upper = std::pow(10, log_h - log_hl + r.lower);
      row.percentile = 100 * normal_probability((log_l - log_h + log_hl) / r.sd);
      break;
    }
    case MobilityKind::length: {
      const double mean = r.a + r.b * (log_v - 6) + r.c * log_h + (event.confined ? r.d : 0);
      row.length = std::pow(10, mean);
      row.percentile = 100 * normal_probability((log_l - mean) / r.sd);
      break;
    }
    case MobilityKind::angle:
      row.length = event.height / std::tan(r.a * degree);
      break;
  }
  row.ratio = event.length / row.length;
  if (!(event.left_share >= least_moved)) row.percentile = no_value;
  return row;
}

std::vector<MobilityEvent> mobility_events(const std::vector<RunoutRun>& runs,
                                           const std::vector<int>& some, bool confined) {
  std::vector<MobilityEvent> events;
  for (const int i : events_among(runs, some)) {
    const MassReach& mass = runs[i].event.mass;
    const Balance& balance = runs[i].balance;
    const bool is_cut = balance.left + balance.moving > (1 - reach_share) * balance.released;
    if (!runs[i].event.moved.of_rocks)
      events.push_back({runs[i].member.info.run_id, mass.moved_volume, mass.height, mass.length,
                        confined, mass.left_share, is_cut});
  }
  return events;
}

MobilityPercentiles percentiles_of(const std::vector<MobilityRelation>& relations,
                                   const std::vector<MobilityEvent>& events) {
  const auto among = [&](const char* id) {
    std::vector<double> values;
    for (const MobilityRelation& relation : relations)
      for (const MobilityEvent& event : events)
        if (const double p = compare(relation, event).percentile; relation.id == id && p >= 0)
          values.push_back(p);
    return median(std::move(values));
  };
  std::vector<double> left;
  for (const MobilityEvent& event : events) left.push_back(event.left_share);
  const bool at_least = std::any_of(events.begin(), events.end(),
                                    [](const MobilityEvent& event) { return event.is_cut; });
  return {median(std::move(left)), among(charted[0].id), among(charted[2].id), at_least};
}

std::string text(const MobilityPercentiles& p) {
  if (std::isnan(p.left_share)) return "";
  if (p.left_share < least_moved)
    return "no percentile among published events: " + percent(p.left_share) +
           " of the mass left its source";
  const auto of = [](const char* group, double value) {
    return std::string(group) + (std::isnan(value) ? " not known" : " " + text(value, 2));
  };
  return "percentile of L95 among published events of its volume: " + of("rockfalls", p.rockfalls) +
         ", " + of("rock avalanches", p.rock_avalanches) +
         (p.at_least ? "; at least: some of it left the terrain or still moved" : "");
}

std::string mobility_text(const std::vector<RunoutRun>& runs,
                          const std::vector<MobilityRelation>& relations, bool confined) {
  const auto line = [&](const std::string& of, const std::vector<int>& some) {
    const std::string words =
        text(percentiles_of(relations, mobility_events(runs, some, confined)));
    return words.empty() ? "" : "\n" + of + words;
  };
  const std::vector<RunoutCase> cases = cases_of(runs);
  if (cases.empty()) return line("", all_of(runs));
  std::string lines;
  for (const RunoutCase& one : cases) lines += line("case " + one.name + ": ", one.runs);
  return lines;
}

Chart mobility_chart(const std::vector<MobilityRelation>& relations,
                     const std::vector<MobilityEvent>& events) {
  Chart chart{"Mobility", "volume V [m³]", "H/L", {}, true, true, 460};
  for (const Charted& shown : charted)
    for (const MobilityRelation& r : relations) {
      if (r.id != shown.id) continue;
      if (r.id == std::string("corominas_slide_all")) chart.series.push_back(band_below(r, shown));
      chart.series.push_back(relation_line(r, shown));
    }
  ChartSeries points{"this event (a point a run)", "#000000", {}, {}, 0, 5};
  for (const MobilityEvent& event : events) {
    if (!(event.volume > 0 && event.height > 0 && event.length > 0)) continue;
    points.x.push_back(std::clamp(event.volume, 1.0, std::pow(10, log_v_high)));
    points.y.push_back(std::clamp(event.height / event.length, hl_low, hl_high));
    points.notes.push_back(event.name);
  }
  chart.series.push_back(std::move(points));
  return chart;
}

}  // namespace talus
