// Sensitivity of results to drawn quantities: rank correlations and first-order indices.
#include "post/runout/runout_sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "base/units.hpp"
#include "sampling/sensitivity.hpp"

namespace talus {
namespace {

// A number a run; NaN where the run has none.
struct Column {
  std::string name;
  std::vector<double> values;
};

bool varies(const std::vector<double>& values) {
  const auto is_known = [](double value) { return std::isfinite(value); };
  const auto first = std::find_if(values.begin(), values.end(), is_known);
  return std::any_of(first, values.end(),
                     [&](double value) { return is_known(value) && value != *first; });
}

template <class Value>
Column column(const std::string& name, const std::vector<RunoutRun>& runs, const Value& value) {
  Column made{name, {}};
  for (const RunoutRun& run : runs) made.values.push_back(value(run));
  return made;
}

double drawn_value(const RunoutRun& run, const std::string& name) {
  for (const DrawnValue& value : run.drawn)
    if (value.name == name) return value.value;
  return no_value;
}

// A ground's own column says the same as that of its key, where the key is drawn.
bool is_said_twice(const std::string& name, const RunoutRun& run) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return false;
  const std::string key = "ground." + name.substr(dot + 1) + "." + name.substr(0, dot);
  return !std::isnan(drawn_value(run, key));
}

std::vector<Column> quantities_of(const std::vector<RunoutRun>& runs) {
  std::vector<Column> columns;
  for (const DrawnValue& value : runs.front().drawn) {
    if (value.name == "sample" || is_said_twice(value.name, runs.front())) continue;
    columns.push_back(column(value.name, runs,
                             [&](const RunoutRun& run) { return drawn_value(run, value.name); }));
    if (!varies(columns.back().values)) columns.pop_back();
  }
  return columns;
}

double crossed(const RunoutRun& run, const std::string& line, double LineReach::*member) {
  for (const LineReach& reach : run.lines)
    if (reach.name == line) return reach.*member;
  return no_value;
}

std::vector<Column> results_of(const std::vector<RunoutRun>& runs) {
  const auto if_moved = [](double (*value)(const EventReach&)) {
    return [value](const RunoutRun& run) {
      return run.event.moved.any() ? value(run.event) : no_value;
    };
  };
  std::vector<Column> columns = {
      column("L_path_m", runs, if_moved([](const EventReach& e) { return e.event.path; })),
      column("reach_angle_path_deg", runs,
             if_moved([](const EventReach& e) { return e.event.path_angle() / degree; })),
      column("L95_m", runs, if_moved([](const EventReach& e) { return e.mass.length; })),
      column("share_moved_1_m", runs, [](const RunoutRun& run) { return run.event.moved.share; })};
  for (const LineReach& line : runs.front().lines) {
    columns.push_back(column("crossed." + line.name, runs, [&](const RunoutRun& run) {
      return crossed(run, line.name, &LineReach::share);
    }));
    columns.push_back(column("energy_kj." + line.name, runs, [&](const RunoutRun& run) {
      return crossed(run, line.name, &LineReach::energy) / 1e3;
    }));
  }
  std::erase_if(columns, [](const Column& c) { return !varies(c.values); });
  return columns;
}

SensitivityRow row_of(const Column& result, const Column& quantity) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < result.values.size(); ++i)
    if (std::isfinite(result.values[i]) && std::isfinite(quantity.values[i])) {
      x.push_back(quantity.values[i]);
      y.push_back(result.values[i]);
    }
  SensitivityRow row{result.name, quantity.name, static_cast<int>(x.size()), no_value, no_value};
  if (row.n < least_runs_for_sensitivity) return row;
  const bool has_order = quantity.name != "rock_mass";
  if (has_order) row.rank_correlation = rank_correlation(x, y);
  row.first_order = has_order ? first_order_index(x, y) : share_between_groups(x, y);
  return row;
}

}  // namespace

std::vector<SensitivityRow> sensitivity_of(const std::vector<RunoutRun>& runs) {
  std::vector<SensitivityRow> rows;
  if (runs.empty()) return rows;
  const std::vector<Column> quantities = quantities_of(runs);
  if (quantities.empty()) return rows;
  for (const Column& result : results_of(runs))
    for (const Column& quantity : quantities) rows.push_back(row_of(result, quantity));
  return rows;
}

const std::vector<Field<SensitivityRow>>& sensitivity_fields() {
  using Value = FieldValue;
  using Row = const SensitivityRow&;
  static const std::vector<Field<SensitivityRow>> fields = {
      {"result", "", "Result", [](Row r) -> Value { return r.result; }, FieldType::text},
      {"quantity", "", "Quantity", [](Row r) -> Value { return r.quantity; }, FieldType::text},
      {"n_runs", "", "Number of runs", [](Row r) -> Value { return r.n; }, FieldType::integer},
      {"rank_correlation", "", "Rank correlation",
       [](Row r) -> Value { return r.rank_correlation; }},
      {"first_order", "", "First-order index", [](Row r) -> Value { return r.first_order; }}};
  return fields;
}

}  // namespace talus
