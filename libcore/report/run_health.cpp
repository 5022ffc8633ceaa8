// Tables of the limits and the numerical health of runs.
#include "report/run_health.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "record/deep_rows.hpp"

namespace talus {
namespace {

using Value = FieldValue;
constexpr FieldType words = FieldType::text, whole = FieldType::integer;

template <std::size_t... cut>
std::vector<Field<RunHealth>> fields_of_cuts(std::index_sequence<cut...> /*all*/) {
  return {{"run", "", "run", [](const RunHealth& r) -> Value { return r.name; }, words},
          {substep_cut_names[cut], "", substep_cut_names[cut],
           [](const RunHealth& r) -> Value { return r.whole.cuts[cut]; }, whole}...};
}

Value map_metre(const DeepOfRun& deep, int axis) {
  return static_cast<std::int64_t>(std::llround(deep.row.place[axis] + deep.run.info.origin[axis]));
}

}  // namespace

void add_limits(const std::vector<RunCheck>& checks, std::vector<LimitOverRuns>& limits) {
  for (const RunCheck& check : checks) {
    auto at = std::find_if(limits.begin(), limits.end(),
                           [&check](const LimitOverRuns& l) { return l.name == check.name; });
    if (at == limits.end()) at = limits.insert(at, {check.name, check.value, check.limit, 0});
    at->worst = std::max(at->worst, check.value);
    if (!check.pass) ++at->n_failed;
  }
}

bool all_pass(const std::vector<RunFile>& runs, const std::vector<LimitOverRuns>& limits) {
  return std::all_of(runs.begin(), runs.end(),
                     [](const RunFile& run) { return run.info.status == "done"; }) &&
         std::all_of(limits.begin(), limits.end(),
                     [](const LimitOverRuns& limit) { return limit.n_failed == 0; });
}

const std::vector<Field<LimitOverRuns>>& limit_fields() {
  using Limit = const LimitOverRuns&;
  static const std::vector<Field<LimitOverRuns>> fields = {
      {"limit", "", "limit", [](Limit l) -> Value { return l.name; }, words},
      {"worst", "", "worst value", [](Limit l) -> Value { return l.worst; }},
      {"largest", "", "largest allowed", [](Limit l) -> Value { return l.limit; }},
      {"n_failed", "", "runs beyond it", [](Limit l) -> Value { return l.n_failed; }, whole},
      {"verdict", "", "verdict", [](Limit l) -> Value { return l.n_failed == 0 ? "pass" : "fail"; },
       words}};
  return fields;
}

std::vector<RunHealth> health_of(const std::vector<RunFile>& runs,
                                 const std::vector<std::string>& names) {
  std::vector<RunHealth> all;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    HealthRow sum;
    for (const HealthRow& row : runs[i].health) {
      sum.steps += row.steps;
      sum.impacts += row.impacts;
      sum.unconverged += row.unconverged;
      sum.left_domain = row.left_domain;
      sum.largest_penetration = std::max(sum.largest_penetration, row.largest_penetration);
      if (row.shortest_dt > 0 && (sum.shortest_dt == 0 || row.shortest_dt < sum.shortest_dt))
        sum.shortest_dt = row.shortest_dt;
      for (std::size_t k = 0; k < sum.cuts.size(); ++k) sum.cuts[k] += row.cuts[k];
    }
    all.push_back({names[i], runs[i].info, sum});
  }
  return all;
}

const std::vector<Field<RunHealth>>& counter_fields() {
  using Run = const RunHealth&;
  static const std::vector<Field<RunHealth>> fields = {
      {"run", "", "run", [](Run r) -> Value { return r.name; }, words},
      {"status", "", "status", [](Run r) -> Value { return r.info.status; }, words},
      {"time_s", "s", "time reached", [](Run r) -> Value { return r.info.time; }},
      {"duration_s", "s", "of", [](Run r) -> Value { return r.info.duration; }},
      {"steps", "", "steps", [](Run r) -> Value { return r.whole.steps; }, whole},
      {"shortest_dt_s", "s", "shortest step", [](Run r) -> Value { return r.whole.shortest_dt; }},
      {"impacts", "", "impacts", [](Run r) -> Value { return r.whole.impacts; }, whole},
      {"unconverged", "", "block steps accepted unconverged",
       [](Run r) -> Value { return r.whole.unconverged; }, whole},
      {"largest_penetration_m", "m", "largest penetration",
       [](Run r) -> Value { return r.whole.largest_penetration; }},
      {"left_domain", "", "blocks that left the terrain",
       [](Run r) -> Value { return r.whole.left_domain; }, whole}};
  return fields;
}

const std::vector<Field<RunHealth>>& cut_fields() {
  static const std::vector<Field<RunHealth>> fields =
      fields_of_cuts(std::make_index_sequence<substep_cut_names.size()>());
  return fields;
}

std::vector<DeepOfRun> deep_of_runs(const std::vector<RunFile>& runs,
                                    const std::vector<std::string>& names) {
  std::vector<DeepOfRun> all;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const DeepRow& row : runs[i].deep) all.push_back({names[i], runs[i], row});
  return all;
}

const std::vector<Field<DeepOfRun>>& deep_fields() {
  using Deep = const DeepOfRun&;
  static const std::vector<Field<DeepOfRun>> fields = {
      {"run", "", "run", [](Deep d) -> Value { return d.name; }, words},
      {"block", "", "block", [](Deep d) -> Value { return d.row.block; }, whole},
      {"in", "", "in", [](Deep d) -> Value { return partner_name(d.row, d.run.lines); }, words},
      {"depth_m", "m", "depth", [](Deep d) -> Value { return d.row.depth; }},
      {"thickness_m", "m", "thickness", [](Deep d) -> Value { return d.row.thickness; }},
      {"steps", "", "steps", [](Deep d) -> Value { return d.row.steps; }, whole},
      {"time_s", "s", "deepest at", [](Deep d) -> Value { return d.row.time; }},
      {"x_m", "m", "x", [](Deep d) -> Value { return map_metre(d, 0); }, whole},
      {"y_m", "m", "y", [](Deep d) -> Value { return map_metre(d, 1); }, whole},
      {"z_m", "m", "z", [](Deep d) -> Value { return map_metre(d, 2); }, whole},
      {"mass_percent", "%", "of the mass", [](Deep d) -> Value { return 100 * d.row.mass_share; }},
      {"ends_in_toe", "", "ends in the toe",
       [](Deep d) -> Value { return d.row.ends_in_toe != 0 ? "yes" : ""; }, words},
      {"met_fence", "", "met a fence",
       [](Deep d) -> Value { return d.row.met_fence != 0 ? "yes" : ""; }, words},
      {"too_fast", "", "too fast for its fall",
       [](Deep d) -> Value { return d.row.is_too_fast != 0 ? "yes" : ""; }, words}};
  return fields;
}

}  // namespace talus
