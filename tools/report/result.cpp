#include "tools/report/result.hpp"

#include <algorithm>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "post/moved.hpp"
#include "post/statistics.hpp"
#include "report/html.hpp"
#include "tools/report/fences.hpp"
#include "tools/report/folder.hpp"
#include "tools/report/json.hpp"
#include "tools/report/runout.hpp"

namespace talus {
namespace {

double number_or(const Json& value, double otherwise) {
  return value.is_number() ? value.get<double>() : otherwise;
}

// Runs of the run-out for which `holds`.
template <class Test>
int count_runs(const Json& runout, const Test& holds) {
  const Json runs = value_at(runout, {"runs"});
  return runs.is_array() ? static_cast<int>(std::count_if(runs.begin(), runs.end(), holds)) : 0;
}

// "largest of 10 runs", "largest of the 17 runs that moved", "of one run"
std::string over_runs(const Json& runout, const char* which) {
  const int n_all = count_runs(runout, [](const Json&) { return true; });
  const int n = count_runs(runout, [](const Json& run) {
    return value_at(run, {"event", "L_path_m"}).is_number();
  });
  if (n_all == 1) return "of one run";
  if (n < n_all) return std::string(which) + " of the " + counted(n, "run") + " that moved";
  return std::string(which) + " of " + counted(n, "run");
}

// "; still moving at the end in 2 runs"
std::string unsettled(const Json& runout) {
  std::string out;
  for (const auto& [fate, words] : {std::pair{"moving", "; it was still moving at the end of "},
                                    std::pair{"left_domain", "; it left the known terrain in "}}) {
    const int n = count_runs(
        runout, [fate = fate](const Json& run) { return value_at(run, {"toe_fate"}) == fate; });
    if (n > 0) out += words + counted(n, "run");
  }
  return out;
}

// "; p95 over the runs 95.2 m" where they are enough for one.
std::string extreme_percentile(const Json& spread, const char* percentile, const char* unit) {
  if (number_or(value_at(spread, {"n"}), 0) < smallest_sample(0.95)) return "";
  return std::string("; ") + percentile + " over the runs " +
         number_text(value_at(spread, {percentile})) + unit;
}

std::string trouble_tiles(const ReportData& data) {
  std::string out;
  const auto tile = [&](std::size_t n, const char* one, const char* several) {
    if (n > 0)
      out += html_fact(std::to_string(n) + " of " + counted(data.faults.n_runs, "run"),
                       n == 1 ? one : several, "bad");
  };
  tile(data.faults.failed.size(), "failed its numerical checks", "failed their numerical checks");
  tile(data.faults.unfinished.size(), "has not reached its end", "have not reached their end");
  const int n_all = count_runs(data.runout, [](const Json&) { return true; });
  const int n_still = count_runs(
      data.runout, [](const Json& run) { return value_at(run, {"did_move"}) == Json(false); });
  if (n_still > 0)
    out += html_fact(std::to_string(n_still) + " of " + counted(n_all, "run"),
                     "did not move: no block by more than " + text(moved_m) +
                         " m. They have no L, H and angle of reach",
                     "bad");
  const int n_few = count_runs(data.runout, [](const Json& run) {
    return value_at(run, {"did_move"}) == Json(true) && value_at(run, {"is_event"}) == Json(false);
  });
  if (n_few > 0)
    out += html_fact(std::to_string(n_few) + " of " + counted(n_all, "run"),
                     "moved less than 10 % of the mass: single blocks, no event", "bad");
  const Json chance = value_at(data.runout, {"event_probability"});
  if (n_still + n_few > 0 && chance.is_number())
    out += html_fact(percent_text(chance),
                     "of the runs are events. Maps and shares count all runs (total); of an event "
                     "(conditional) they are divided by this");
  return out;
}

std::string moved_tile(const Json& moved) {
  return html_fact(percent_text(value_at(moved, {"share_moved_1_m"})),
                   "of the released mass moved more than 1 m, " +
                       percent_text(value_at(moved, {"share_moved_20_m"})) +
                       " more than 20 m. Displacement by mass, straight from start to end: p50 " +
                       number_text(value_at(moved, {"displacement_p50_m"}), 3) + " m, p90 " +
                       number_text(value_at(moved, {"displacement_p90_m"}), 3) + " m, p95 " +
                       number_text(value_at(moved, {"displacement_p95_m"}), 3) + " m",
                   "two");
}

std::string reach_tiles(const Json& r) {
  const auto of = [&r](const char* key, const char* what) {
    return value_at(r, {"spread_over_runs", key, what});
  };
  const Json length = value_at(r, {"spread_over_runs", "L_path_m"});
  const Json angle = value_at(r, {"spread_over_runs", "reach_angle_path_deg"});
  return html_fact(number_text(of("H_m", "max")) + " m",
                   "H, drop from the top of the source to the farthest block, " +
                       over_runs(r, "largest")) +
         html_fact(number_text(of("L_path_m", "max")) + " m",
                   "L, run-out of the farthest block along its path, " + over_runs(r, "largest") +
                       extreme_percentile(length, "p95", " m") + unsettled(r)) +
         html_fact(number_text(of("L95_m", "max")) + " m",
                   "L95, straight from its top, within which 95 % of the mass that moved came, " +
                       over_runs(r, "largest")) +
         html_fact(number_text(of("reach_angle_path_deg", "min"), 3) + "&deg;",
                   "angle of reach, atan(H/L), " + over_runs(r, "smallest") +
                       extreme_percentile(angle, "p05", "&deg;"));
}

// Speed of any block, path of the centre of mass, area.
std::string motion_tiles(const Json& r) {
  double fastest = 0, path = 0;
  int n = 0;
  const Json runs = value_at(r, {"runs"});
  for (std::size_t i = 0; runs.is_array() && i < runs.size(); ++i) {
    fastest = std::max(fastest, number_or(value_at(runs[i], {"max_speed_m_s"}), 0));
    const Json length = value_at(runs[i], {"centre_of_mass", "L_path_m"});
    if (!length.is_number()) continue;
    path += length.get<double>();
    ++n;
  }
  return (n == 0 ? ""
                 : html_fact(grouped_text(path / n, 3) + " m",
                             "path of the centre of mass of all blocks, in plan, " +
                                 over_runs(r, "mean"))) +
         html_fact(text(fastest, 3) + " m/s", "largest speed of any block in any run") +
         html_fact(number_text(value_at(r, {"swept_area_m2"})) + " m&sup2;",
                   "area that any block of any run passed");
}

std::string fault_table(const RunFaults& faults) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [list, kind] :
       {std::pair{&faults.failed, "failed"}, std::pair{&faults.unfinished, "not finished"}})
    for (const RunFault& fault : *list)
      rows.push_back({xml_escaped(fault.name), kind, xml_escaped(fault.words)});
  return html_table({"run", "", "broken limit, its value"}, rows);
}

std::string health_verdict(const ReportData& data) {
  const std::string wrong = headline(data.faults);
  if (!wrong.empty())
    return "<div class=\"verdict fail\"><b>Numerical checks: failed.</b> " + xml_escaped(wrong) +
           ". What these runs say is not to be relied on before the cause is found; see <a "
           "href=\"#health\">the checks</a>.</div>\n" +
           fault_table(data.faults);
  if (all_pass(data.runs, data.limits))
    return "<div class=\"verdict pass\"><b>Numerical checks: passed.</b> All runs finished within "
           "their "
           "limits.</div>\n";
  return "<div class=\"verdict fail\"><b>Numerical checks: failed.</b> A limit is broken; see <a "
         "href=\"#health\">the checks</a>.</div>\n";
}

std::string standing_mass(const Json& moved) {
  if (!(number_or(value_at(moved, {"share_moved_1_m"}), 1) < least_moved)) return "";
  if (!(number_or(value_at(moved, {"displacement_max_m"}), 0) > moved_m))
    return "<div class=\"verdict warn\"><b>Nothing moved:</b> no block by more than 1 m, so there "
           "is no run-out.</div>\n";
  return "<div class=\"verdict warn\"><b>Less than half of the released mass moved.</b> L and the "
         "angle of reach are those of few blocks, not of the released volume: see whether the "
         "failure surface comes out at the foot of the source.</div>\n";
}

// Failed runs, few enough to be left out.
std::string left_out_verdict(const Json& runout) {
  const Json runs = value_at(runout, {"left_out_runs"});
  if (!runs.is_array() || runs.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const Json& run : runs)
    rows.push_back({word_text(value_at(run, {"run"})), number_text(value_at(run, {"seed"})),
                    word_text(value_at(run, {"reason"}))});
  return "<div class=\"verdict warn\"><b>" +
         counted(static_cast<std::int64_t>(runs.size()), "run") +
         " failed and left out.</b> Intervals of shares count them: all may have reached a place, "
         "or "
         "none.</div>\n" +
         html_table({"run", "seed", "broken limit, its value"}, rows);
}

// Runs that were wanted and gave no result: what is shown is of the rest.
std::string missing_verdict(const Json& runout) {
  const std::string n = text_at(runout, "/tags/N_MISSING");
  if (n.empty()) return "";
  return "<div class=\"verdict fail\"><b>Runs missing: " + n +
         ".</b> They gave no result; all that is shown is of the other " +
         word_text(value_at(runout, {"tags", "N_RUNS"})) + ".</div>\n";
}

}  // namespace

std::string result_section(const ReportData& data) {
  const Json& r = data.runout;
  const Json moved = value_at(r, {"moved"});
  const std::size_t n = data.runs.size();
  std::string out = "<div class=\"facts\">\n" + trouble_tiles(data) + moved_tile(moved);
  out += reach_tiles(r) + motion_tiles(r);
  out += html_fact(std::to_string(n), n == 1 ? "run" : "runs");
  out += html_fact(number_text(value_at(data.blocks, {"n_blocks"})), "blocks");
  out += html_fact(number_text(value_at(data.blocks, {"volume_m3"})) + " m&sup3;", "released rock");
  out += "</div>\n";
  if (const std::string cases = case_table(r); !cases.empty())
    out += "<h3>Case by case</h3>\n" + cases;
  out += standing_mass(moved) + health_verdict(data);
  out += left_out_verdict(data.runout) + missing_verdict(data.runout);
  out += fence_verdicts(data);
  return html_section("result", "Result", out);
}

}  // namespace talus
