#include "report/run_health.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "record/deep_rows.hpp"
#include "report/html.hpp"

namespace talus {
namespace {

std::string n_of(const Texts& texts, const std::string& n, const std::string& all) {
  return texts.of("words.n_of", {{"n", n}, {"all", all}});
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

std::string limit_table(const Texts& texts, const std::vector<LimitOverRuns>& limits,
                        std::size_t n_runs) {
  std::vector<std::vector<std::string>> rows;
  for (const LimitOverRuns& limit : limits) {
    const bool pass = limit.n_failed == 0;
    rows.push_back({xml_escaped(limit.name), text(limit.worst, 4), text(limit.limit, 4),
                    n_of(texts, std::to_string(limit.n_failed), std::to_string(n_runs)),
                    pass ? "<b class=\"pass\">" + texts.of("health.kept") + "</b>"
                         : "<b class=\"fail\">" + texts.of("health.broken") + "</b>"});
  }
  return html_table(texts.list("health.limit_heads"), rows, {false, true, true, true, false});
}

std::string counter_table(const Texts& texts, const std::vector<RunFile>& runs,
                          const std::vector<std::string>& names) {
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
                    n_of(texts, text(run.info.time, 4), text(run.info.duration, 4)),
                    std::to_string(sum.steps), text(shortest, 3), std::to_string(sum.impacts),
                    std::to_string(sum.unconverged), text(sum.largest_penetration, 3),
                    std::to_string(sum.left_domain)});
  }
  return html_table(texts.list("health.counter_heads"), rows,
                    {false, false, true, true, true, true, true, true, true});
}

std::string cut_table(const Texts& texts, const std::vector<RunFile>& runs,
                      const std::vector<std::string>& names) {
  std::vector<std::string> heads = {texts.of("health.run")};
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

std::string deep_table(const Texts& texts, const std::vector<RunFile>& runs,
                       const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (const DeepRow& deep : runs[i].deep) {
      const Vec3 at = deep.place + runs[i].info.origin;
      std::string matters;
      const auto add = [&](int is_so, const char* what) {
        if (is_so != 0) matters += (matters.empty() ? "" : ", ") + texts.of(what);
      };
      add(deep.ends_in_toe, "health.ends_in_toe");
      add(deep.met_fence, "health.met_fence");
      add(deep.is_too_fast, "health.too_fast");
      rows.push_back({xml_escaped(names[i]), std::to_string(deep.block),
                      xml_escaped(partner_name(deep, runs[i].lines)), text(deep.depth, 3),
                      text(deep.thickness, 3), std::to_string(deep.steps), text(deep.time, 4),
                      text(at.x(), 9), text(at.y(), 9), text(at.z(), 6),
                      text(100 * deep.mass_share, 3), matters});
    }
  if (rows.empty()) return "";
  return html_table(texts.list("health.deep_heads"), rows,
                    {false, true, false, true, true, true, true, true, true, true, true, false});
}

}  // namespace talus
