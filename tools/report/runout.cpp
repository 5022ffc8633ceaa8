#include "tools/report/runout.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

// "Over the 17 of 36 runs that are events (at least 10 % of the mass moved)"
std::string over_which(const Texts& texts, const Json& runout) {
  const std::string n = number_text(value_at(runout, {"n_events"})),
                    all = number_text(value_at(runout, {"n_runs"}));
  return n == all ? texts.of("runout.over_all")
                  : texts.of("runout.over_events", {{"n", n}, {"all", all}});
}

std::string spread_table(const Texts& texts, const Json& runout) {
  const Json spread = value_at(runout, {"spread_over_events"});
  if (number_text(value_at(runout, {"n_runs_moved"})) == "0")
    return html_paragraph(texts.of("runout.none_moved"));
  if (number_text(value_at(runout, {"n_events"})) == "0")
    return html_paragraph(texts.of("runout.no_event"));
  static const std::pair<const char*, const char*> rows[] = {
      {"H_m", "runout.drop"},
      {"L_path_m", "runout.length"},
      {"L_chord_m", "runout.chord"},
      {"reach_angle_path_deg", "runout.angle"},
      {"reach_angle_chord_deg", "runout.chord_angle"},
      {"L95_m", "runout.length_95"},
      {"reach_angle_95_deg", "runout.angle_95"},
      {"H_cm_over_L_cm", "runout.centre"}};
  // One run has no spread: its value stands alone.
  const bool one = number_text(value_at(spread, {"H_m", "n"})) == "1";
  std::vector<const char*> columns = {"mean", "min", "p50", "p95", "max"};
  if (one) columns = {"mean"};
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, name] : rows) {
    std::vector<std::string> row = {texts.of(name)};
    for (const char* column : columns) row.push_back(number_text(value_at(spread, {key, column})));
    table.push_back(row);
  }
  return html_table(texts.list(one ? "runout.one_run_heads" : "runout.heads"), table,
                    {false, true, true, true, true, true}) +
         (one ? (number_text(value_at(runout, {"n_runs"})) == "1"
                     ? ""
                     : html_note(over_which(texts, runout) + "."))
              : html_note(texts.of("runout.percentiles", {{"over", over_which(texts, runout)}})));
}

std::string mobility_table(const Texts& texts, const Json& mobility) {
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
                               ? " <b>" + texts.of("runout.from_memory") + "</b>"
                               : "")});
    }
  return html_table(texts.list("runout.relation_heads"), rows,
                    {false, false, true, true, true, false});
}

// What H/L of the centre of mass is compared with: tan(phi) of the ground, as the runs had it.
std::string friction_paragraph(const ReportData& data) {
  const Texts& texts = data.texts;
  std::map<std::string, std::pair<double, double>> grounds;  // least and most friction [deg]
  for (const RunFile& run : data.runs)
    for (const GroundSettings& ground : parse_site(run.info.config, run.info.run_id).grounds) {
      auto& [low, high] =
          grounds.try_emplace(ground.name, ground.friction_deg, ground.friction_deg).first->second;
      low = std::min(low, ground.friction_deg);
      high = std::max(high, ground.friction_deg);
    }
  const auto tangent = [](double degrees) { return text(std::tan(degrees * degree), 3); };
  std::string list;
  for (const auto& [name, range] : grounds) {
    const auto& [low, high] = range;
    list += (list.empty() ? "" : "; ") + xml_escaped(name) + ": ";
    if (low == high)
      list += texts.of("runout.tangent", {{"degrees", text(low, 4)}, {"tangent", tangent(low)}});
    else
      list += texts.of("runout.tangents",
                       {{"tangents", range_text(texts, tangent(low), tangent(high))},
                        {"degrees", range_text(texts, text(low, 3), text(high, 3))}});
  }
  return html_paragraph(texts.of("runout.friction", {{"grounds", list}}));
}

// Of the run of the animation, the farthest one.
std::string energy_line_note(const ReportData& data) {
  const Json runs = value_at(data.runout, {"runs"});
  for (std::size_t i = 0; runs.is_array() && i < runs.size(); ++i) {
    const std::string words = word_text(value_at(runs[i], {"energy_line"}));
    if (runs[i].value("run_id", "") == data.shown.info.run_id && !words.empty())
      return html_note(data.texts.of("runout.energy_line",
                                     {{"run", xml_escaped(data.shown_name)}, {"line", words}}));
  }
  return "";
}

}  // namespace

std::string case_table(const Texts& texts, const Json& runout) {
  const Json cases = value_at(runout, {"cases"});
  if (!cases.is_array() || cases.empty()) return "";
  std::vector<std::vector<std::string>> rows;
  for (const Json& one : cases) {
    const Json spread = value_at(one, {"spread_over_runs"});
    const Json share = value_at(one, {"moved", "share_moved_1_m"});
    rows.push_back({word_text(value_at(one, {"case"})),
                    texts.of("words.n_of", {{"n", number_text(value_at(one, {"n_runs_moved"}))},
                                            {"all", number_text(value_at(one, {"n_runs"}))}}),
                    percent_text(value_at(one, {"event_probability"})),
                    percent_text(value_at(one, {"weight"})),
                    share.is_number() ? percent(share.get<double>()) : "",
                    number_text(value_at(spread, {"L_path_m", "p50"})),
                    number_text(value_at(spread, {"L_path_m", "max"})),
                    number_text(value_at(spread, {"L95_m", "max"})),
                    number_text(value_at(spread, {"reach_angle_path_deg", "min"}), 3)});
  }
  return html_table(texts.list("runout.case_heads"), rows,
                    {false, true, true, true, true, true, true, true, true}) +
         html_note(texts.of(value_at(runout, {"cases_weighed"}) == Json(true)
                                ? "runout.cases_weighed"
                                : "runout.cases_alike"));
}

std::string runout_section(const ReportData& data) {
  if (data.runout.is_null()) return "";
  const Json balance = value_at(data.runout, {"balance"});
  const Texts& texts = data.texts;
  std::string out =
      spread_table(texts, data.runout) + energy_line_note(data) + friction_paragraph(data);
  out += html_paragraph(
      texts.of("runout.volume", {{"released", number_text(value_at(balance, {"released_m3"}), 4)},
                                 {"at_rest", number_text(value_at(balance, {"deposited_m3"}), 4)},
                                 {"moving", number_text(value_at(balance, {"moving_m3"}), 4)},
                                 {"left", number_text(value_at(balance, {"left_domain_m3"}), 4)}}));
  const std::string n_moving = number_text(value_at(balance, {"n_moving"}));
  if (n_moving != "0")
    out += html_note(texts.of(n_moving == "1" ? "runout.one_still_moves" : "runout.some_still_move",
                              {{"n", n_moving}}));
  if (!data.mobility_svg.empty())
    out += html_figure(html_svg(data.mobility_svg, texts.of("runout.mobility")),
                       texts.of("runout.mobility_caption"));
  out += html_fold(texts.of("runout.relations"),
                   mobility_table(texts, value_at(data.runout, {"mobility"})));
  return html_section("runout", texts.of("runout.title"), out);
}

}  // namespace talus
