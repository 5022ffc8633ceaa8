#include "tools/report/runout.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/text.hpp"
#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

// "Over the 17 of 36 runs that are events (at least 10 % of the mass moved)"
std::string over_which(const Json& runout) {
  const std::string n = number_text(value_at(runout, {"n_events"})),
                    all = number_text(value_at(runout, {"n_runs"}));
  return n == all ? "Over the runs"
                  : "Over the " + n + " of " + all +
                        " runs that are events (at least 10 % of the mass moved)";
}

std::string spread_table(const Json& runout) {
  const Json spread = value_at(runout, {"spread_over_events"});
  if (number_text(value_at(runout, {"n_runs_moved"})) == "0")
    return html_paragraph("No block moved in any run: there is no run-out.");
  if (number_text(value_at(runout, {"n_events"})) == "0")
    return html_paragraph(
        "In no run did 10 % of the mass move: single blocks fell, and there is no event to "
        "average.");
  static const std::pair<const char*, const char*> rows[] = {
      {"H_m", "H, drop from top to toe [m]"},
      {"L_path_m", "L along the path [m]"},
      {"L_chord_m", "L straight [m]"},
      {"reach_angle_path_deg", "angle of reach, path [deg]"},
      {"reach_angle_chord_deg", "angle of reach, straight [deg]"},
      {"L95_m", "L95, straight, of 95 % of what moved [m]"},
      {"reach_angle_95_deg", "angle of reach of 95 % of what moved [deg]"},
      {"H_cm_over_L_cm", "H/L of the centre of mass [1]"}};
  // One run has no spread: its value stands alone.
  const bool one = number_text(value_at(spread, {"H_m", "n"})) == "1";
  std::vector<std::string> headings = {"quantity", "mean", "min", "p50", "p95", "max"};
  if (one) headings = {"quantity", "value"};
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, name] : rows) {
    std::vector<std::string> row = {name};
    for (std::size_t c = 1; c < headings.size(); ++c)
      row.push_back(number_text(value_at(spread, {key, one ? "mean" : headings[c].c_str()})));
    table.push_back(row);
  }
  return html_table(headings, table, {false, true, true, true, true, true}) +
         (one ? (number_text(value_at(runout, {"n_runs"})) == "1"
                     ? ""
                     : html_note(over_which(runout) + "."))
              : html_note(over_which(runout) +
                          "; p50: half of them lie below, p95: 95 in 100 lie below."));
}

std::string mobility_table(const Json& mobility) {
  std::vector<std::vector<std::string>> rows;
  if (mobility.is_array())
    for (const Json& relation : mobility) {
      const Json runs = value_at(relation, {"runs"});
      const Json first = runs.is_array() && !runs.empty() ? runs[0] : Json();
      const Json from_memory = value_at(relation, {"from_memory"});
      rows.push_back({word_text(value_at(relation, {"relation"})),
                      word_text(value_at(relation, {"path"})),
                      number_text(value_at(first, {"L_expected_m"})),
                      number_text(value_at(first, {"L_over_expected"}), 3),
                      number_text(value_at(first, {"exceedance_probability"}), 2),
                      word_text(value_at(relation, {"source"})) +
                          (from_memory.is_boolean() && from_memory.get<bool>()
                               ? " <b>(not checked against the print: check before use)</b>"
                               : "")});
    }
  return html_table(
      {"relation", "path", "L expected [m]", "L here / expected", "P(longer)", "source"}, rows,
      {false, false, true, true, true, false});
}

// What H/L of the centre of mass is compared with: tan(phi) of the ground, as the runs had it.
std::string friction_paragraph(const ReportData& data) {
  std::map<std::string, std::pair<double, double>> grounds;  // least and most friction [deg]
  for (const RunFile& run : data.runs)
    for (const GroundSettings& ground : parse_site(run.info.config, run.info.run_id).grounds) {
      auto& [low, high] =
          grounds.try_emplace(ground.name, ground.friction_deg, ground.friction_deg).first->second;
      low = std::min(low, ground.friction_deg);
      high = std::max(high, ground.friction_deg);
    }
  const auto tangent = [](double degrees) {
    return text(std::tan(degrees * std::numbers::pi / 180), 3);
  };
  std::string list;
  for (const auto& [name, range] : grounds) {
    const auto& [low, high] = range;
    list += (list.empty() ? "" : "; ") + xml_escaped(name) + ": ";
    if (low == high)
      list += "tan " + text(low, 4) + "&deg; = " + tangent(low);
    else
      list += tangent(low) + " to " + tangent(high) + " in the runs, for " + text(low, 3) + " to " +
              text(high, 3) + "&deg;";
  }
  return html_paragraph(
      "A mass that only slides has H/L of its centre of mass equal to the tangent of "
      "the ground's friction angle (" +
      list + "); a hollow that holds it back, rolling and impacts move it away from that.");
}

// Of the run of the animation, the farthest one.
std::string energy_line_note(const ReportData& data) {
  const Json runs = value_at(data.runout, {"runs"});
  for (std::size_t i = 0; runs.is_array() && i < runs.size(); ++i) {
    const std::string words = word_text(value_at(runs[i], {"energy_line"}));
    if (runs[i].value("run_id", "") == data.shown.info.run_id && !words.empty())
      return html_note("Run " + xml_escaped(data.shown_name) + ", " + words + ".");
  }
  return "";
}

}  // namespace

std::string case_table(const Json& runout) {
  const Json cases = value_at(runout, {"cases"});
  if (!cases.is_array() || cases.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const Json& one : cases) {
    const Json spread = value_at(one, {"spread_over_runs"});
    const Json share = value_at(one, {"moved", "share_moved_1_m"});
    rows.push_back({word_text(value_at(one, {"case"})),
                    number_text(value_at(one, {"n_runs_moved"})) + " of " +
                        number_text(value_at(one, {"n_runs"})),
                    percent_text(value_at(one, {"event_probability"})),
                    percent_text(value_at(one, {"weight"})),
                    share.is_number() ? text(100 * share.get<double>(), 3) + " %" : "",
                    number_text(value_at(spread, {"L_path_m", "p50"})),
                    number_text(value_at(spread, {"L_path_m", "max"})),
                    number_text(value_at(spread, {"L95_m", "max"})),
                    number_text(value_at(spread, {"reach_angle_path_deg", "min"}), 3)});
  }
  return html_table({"case", "runs that moved", "events", "weight", "mass that moved more than 1 m",
                     "L, median [m]", "L, largest [m]", "L95, largest [m]",
                     "angle of reach, smallest [deg]"},
                    rows, {false, true, true, true, true, true, true, true, true}) +
         html_note(
             value_at(runout, {"cases_weighed"}) == Json(true)
                 ? "All other numbers and maps of this page take the cases together, with "
                   "these weights."
                 : "Nobody gave the cases weights (make WEIGHTS='CASE=NUMBER ...'): all other "
                   "numbers and maps of this page count each run alike, and their shares are "
                   "no probabilities.");
}

std::string runout_section(const ReportData& data) {
  if (data.runout.is_null()) return "";
  const Json balance = value_at(data.runout, {"balance"});
  std::string out = spread_table(data.runout) + energy_line_note(data) + friction_paragraph(data);
  out += html_paragraph("Volume: released " + number_text(value_at(balance, {"released_m3"}), 4) +
                        " m&sup3; = at rest " +
                        number_text(value_at(balance, {"deposited_m3"}), 4) + " + still moving " +
                        number_text(value_at(balance, {"moving_m3"}), 4) + " + left the terrain " +
                        number_text(value_at(balance, {"left_domain_m3"}), 4) +
                        " (sum over the runs).");
  const std::string n_moving = number_text(value_at(balance, {"n_moving"}));
  if (n_moving != "0")
    out += html_note(
        n_moving + (n_moving == "1" ? " block" : " blocks") +
        " still moved when their run ended: L counts them where they were at that moment. "
        "With a longer [solver] duration_s they come to rest.");
  if (!data.mobility_svg.empty())
    out += html_figure(html_svg(data.mobility_svg, "H over L against volume"),
                       "Each run beside published relations of H/L and volume.");
  out += html_fold("Published relations", mobility_table(value_at(data.runout, {"mobility"})));
  return html_section("runout", "Run-out and mobility", out);
}

}  // namespace talus
