#include "report_result.hpp"

#include <algorithm>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "report/html.hpp"
#include "report_fences.hpp"
#include "report_folder.hpp"
#include "report_json.hpp"

namespace talus {
namespace {

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
  const auto mean = [&r](const char* key) {
    return value_at(r, {"spread_over_runs", key, "mean"});
  };
  double fastest = 0, way = 0;  // of any block; of the centre of mass, mean of the runs
  if (value_at(r, {"runs"}).is_array())
    for (const Json& run : r["runs"]) {
      if (value_at(run, {"max_speed_m_s"}).is_number())
        fastest = std::max(fastest, run["max_speed_m_s"].get<double>());
      if (const Json length = value_at(run, {"centre_of_mass", "L_path_m"}); length.is_number())
        way += length.get<double>() / static_cast<double>(r["runs"].size());
    }
  const std::size_t n = data.runs.size();
  std::string out = "<div class=\"facts\">\n";
  out += html_fact(std::to_string(n), n == 1 ? "run" : "runs");
  out += html_fact(number_text(value_at(data.blocks, {"n_blocks"})), "blocks");
  out += html_fact(number_text(value_at(data.blocks, {"volume_m3"})) + " m&sup3;", "released rock");
  out += html_fact(number_text(mean("H_m")) + " m", "H, drop from the top to the farthest block");
  out += html_fact(number_text(mean("L_path_m")) + " m",
                   "L, run-out of the farthest block along its path");
  out += html_fact(number_text(mean("reach_angle_path_deg"), 3) + "&deg;",
                   "angle of reach, atan(H/L)");
  out += html_fact(grouped_text(way, 3) + " m", "way of the centre of mass of all blocks, in plan");
  out += html_fact(text(fastest, 3) + " m/s", "largest speed of a block");
  out += html_fact(number_text(value_at(r, {"swept_area_m2"})) + " m&sup2;", "swept area");
  out += "</div>\n";
  out += all_pass(data.runs, data.limits)
             ? "<div class=\"verdict pass\"><b>Health: pass.</b> All runs finished within their "
               "limits.</div>\n"
             : "<div class=\"verdict fail\"><b>Health: fail.</b> " +
                   word_text(value_at(r, {"tags", "HEALTH"})) +
                   ". The numbers below are shown to find the cause, not to be used; see <a "
                   "href=\"#health\">health</a>.</div>\n";
  out += missing_verdict(r);
  if (value_at(data.fence, {"fences"}).is_array())
    for (const Json& fence : data.fence["fences"]) out += fence_verdict(fence);
  return html_section("result", "Result", out);
}

}  // namespace talus
