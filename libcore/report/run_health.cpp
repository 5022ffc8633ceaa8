#include "report/run_health.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "record/deep_rows.hpp"
#include "report/html.hpp"

namespace talus {

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

std::string limit_table(const std::vector<LimitOverRuns>& limits, std::size_t n_runs) {
  std::vector<std::vector<std::string>> rows;
  for (const LimitOverRuns& limit : limits) {
    const bool pass = limit.n_failed == 0;
    rows.push_back({xml_escaped(limit.name), text(limit.worst, 4), text(limit.limit, 4),
                    std::to_string(limit.n_failed) + " of " + std::to_string(n_runs),
                    pass ? "<b class=\"pass\">pass</b>" : "<b class=\"fail\">fail</b>"});
  }
  return html_table({"limit", "worst value", "limit", "runs beyond it", ""}, rows,
                    {false, true, true, true, false});
}

std::string counter_table(const std::vector<RunFile>& runs, const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const RunFile& run = runs[i];
    HealthRow sum;
    double shortest = 0;
    for (const HealthRow& row : run.health) {
      sum.steps += row.steps;
      sum.impacts += row.impacts;
      sum.unconverged += row.unconverged;
      sum.left_domain = row.left_domain;
      sum.largest_penetration = std::max(sum.largest_penetration, row.largest_penetration);
      if (row.shortest_dt > 0 && (shortest == 0 || row.shortest_dt < shortest))
        shortest = row.shortest_dt;
    }
    rows.push_back({xml_escaped(names[i]), xml_escaped(run.info.status),
                    text(run.info.time, 4) + " of " + text(run.info.duration, 4),
                    std::to_string(sum.steps), text(shortest, 3), std::to_string(sum.impacts),
                    std::to_string(sum.unconverged), text(sum.largest_penetration, 3),
                    std::to_string(sum.left_domain)});
  }
  return html_table({"run", "status", "time [s]", "steps", "shortest step [s]", "impacts",
                     "steps of a block accepted unconverged", "largest penetration [m]",
                     "blocks that left the terrain"},
                    rows, {false, false, true, true, true, true, true, true, true});
}

std::string cut_table(const std::vector<RunFile>& runs, const std::vector<std::string>& names) {
  std::vector<std::string> heads = {"run"};
  heads.insert(heads.end(), substep_cut_names.begin(), substep_cut_names.end());
  std::vector<std::vector<std::string>> rows;
  bool any = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::vector<std::string>& row = rows.emplace_back(1, xml_escaped(names[i]));
    for (std::size_t k = 0; k < substep_cut_names.size(); ++k) {
      std::int64_t n = 0;
      for (const HealthRow& health : runs[i].health) n += health.cuts[k];
      row.push_back(std::to_string(n));
      any |= n > 0;
    }
  }
  std::vector<bool> is_number(heads.size(), true);
  is_number[0] = false;
  return any ? html_table(heads, rows, is_number) : "";
}

std::string deep_table(const std::vector<RunFile>& runs, const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const DeepRow& deep : runs[i].deep) {
      const Vec3 at = deep.place + runs[i].info.origin;
      std::string matters = deep.ends_in_toe != 0 ? "ends in the toe" : "";
      const auto add = [&matters](int is_so, const char* what) {
        if (is_so != 0) matters += std::string(matters.empty() ? "" : ", ") + what;
      };
      add(deep.met_fence, "met a fence");
      add(deep.is_too_fast, "too fast for its fall");
      rows.push_back({xml_escaped(names[i]), std::to_string(deep.block),
                      xml_escaped(partner_name(deep, runs[i].lines)), text(deep.depth, 3),
                      text(deep.thickness, 3), std::to_string(deep.steps), text(deep.time, 4),
                      text(at.x(), 9), text(at.y(), 9), text(at.z(), 6),
                      text(100 * deep.mass_share, 3), matters});
    }
  if (rows.empty()) return "";
  return html_table({"run", "block", "in", "depth [m]", "thickness [m]", "steps", "deepest at [s]",
                     "x [m]", "y [m]", "z [m]", "of the mass [%]", "why it matters"},
                    rows,
                    {false, true, false, true, true, true, true, true, true, true, true, false});
}

}  // namespace talus
