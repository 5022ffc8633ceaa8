#include "tools/report/fences.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

// "1 stopped, 56 did not reach it"
std::string verdict_counts(const Texts& texts, const Json& fence) {
  std::string out;
  const Json verdicts = value_at(fence, {"verdicts"});
  if (verdicts.is_object())
    for (const auto& [name, v] : verdicts.items())
      if (number_text(value_at(v, {"n"})) != "0")
        out += (out.empty() ? "" : ", ") + number_text(value_at(v, {"n"})) + " " +
               (name == "not_reached" ? texts.of("fences.not_reached") : xml_escaped(name));
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

std::string verdict_table(const Texts& texts, const Json& verdicts) {
  std::vector<std::vector<std::string>> rows;
  if (verdicts.is_object())
    for (const auto& [name, v] : verdicts.items()) {
      std::string label = name;
      std::replace(label.begin(), label.end(), '_', ' ');
      const bool bounded = value_at(v, {"low"}).is_number();
      rows.push_back({xml_escaped(label), number_text(value_at(v, {"n"})),
                      percent_text(value_at(v, {"share"})),
                      bounded ? range_text(texts, percent_text(value_at(v, {"low"})),
                                           percent_text(value_at(v, {"high"})))
                              : texts.of("fences.too_few_runs")});
    }
  return html_table(texts.list("fences.verdict_heads"), rows, {false, true, true, true});
}

std::string arrival_table(const Texts& texts, const Json& whole) {
  static const std::pair<const char*, const char*> rows[] = {
      {"energy_kj", "fences.energy"},
      {"translational_energy_kj", "fences.translation"},
      {"top_height_m", "fences.top"},
      {"speed_m_s", "fences.speed"}};
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, name] : rows) {
    std::vector<std::string> row = {texts.of(name)};
    for (const char* column : {"p50", "p90", "p95", "p95_hi", "p99", "max"})
      row.push_back(number_text(value_at(whole, {key, column})));
    table.push_back(row);
  }
  return html_table(texts.list("fences.arrival_heads"), table,
                    {false, true, true, true, true, true, true});
}

// From the design block and speed to what is needed, each number with its source.
// What is needed is rounded up, here as in the verdict.
std::string needed_number(const Json& value) {
  return value.is_number() ? needed_text(value.get<double>(), 3) : number_text(value);
}

bool is_needed(const Json& step) {
  const std::string symbol = word_text(value_at(step, {"symbol"}));
  return symbol == "E_req" || symbol == "h_req";
}

std::string derivation_table(const Texts& texts, const Json& steps) {
  std::vector<std::vector<std::string>> rows;
  if (steps.is_array())
    for (const Json& step : steps)
      rows.push_back({word_text(value_at(step, {"symbol"})), word_text(value_at(step, {"name"})),
                      (is_needed(step) ? needed_number(value_at(step, {"value"}))
                                       : number_text(value_at(step, {"value"}))) +
                          " " + word_text(value_at(step, {"unit"})),
                      word_text(value_at(step, {"source"}))});
  if (rows.empty()) return "";
  return "<h3>" + texts.of("fences.derivation") + "</h3>\n" +
         html_table(texts.list("fences.derivation_heads"), rows, {false, false, true, false});
}

// The line that stops nothing beside the touches of the standing fence: which of them is for
// design.
std::string arrival_tables(const Texts& texts, const Json& fence) {
  const Json open = value_at(fence, {"at_open_line"});
  const Json basis = value_at(fence, {"design", "basis"});
  const Json whole = value_at(fence, {"whole"});
  const bool came = number_text(value_at(whole, {"n"})) != "0";
  if (basis == "line that stops nothing") return came ? arrival_table(texts, whole) : "";
  std::string out;
  if (open.is_object() && number_text(value_at(open, {"n"})) != "0")
    out += "<h3>" + texts.of("fences.open_line") + "</h3>\n" + arrival_table(texts, open);
  if (came)
    out += "<h3>" + texts.of("fences.first_touches") + "</h3>\n" + arrival_table(texts, whole);
  return out;
}

// Below every number that a rigid fence has made.
std::string wall_note(const Texts& texts, const Json& fence) {
  if (value_at(fence, {"capacity_kj"}).is_number() || !value_at(fence, {"standing"}).is_boolean() ||
      !value_at(fence, {"standing"}).get<bool>())
    return "";
  return html_note(texts.of("fences.rigid"));
}

// What came to the fence, and what it holds.
std::string arrivals(const Texts& texts, const Json& fence) {
  const Json whole = value_at(fence, {"whole"}), kept = value_at(fence, {"kept_from_passing_m3"});
  const std::string held = texts.of(kept.is_number() ? "fences.held_and_kept" : "fences.held",
                                    {{"stopped", number_text(value_at(fence, {"retained_m3"}))},
                                     {"kept", number_text(kept)},
                                     {"storage", number_text(value_at(fence, {"storage_m3"}))}});
  if (number_text(value_at(whole, {"n"})) == "0")
    return arrival_tables(texts, fence) +
           html_paragraph(texts.of("fences.nothing_at_fence", {{"held", held}})) +
           wall_note(texts, fence);
  return arrival_tables(texts, fence) +
         html_paragraph(
             texts.of("fences.arrivals",
                      {{"touches", number_text(value_at(fence, {"arrivals", "first_touches"}))},
                       {"crossings", number_text(value_at(fence, {"arrivals", "crossings"}))},
                       {"most", number_text(value_at(whole, {"most_hits_in_a_run"}))},
                       {"in_a_second", number_text(value_at(whole, {"hits_in_that_second"}))},
                       {"energy", number_text(value_at(whole, {"energy_in_one_second_kj"}))},
                       {"held", held}})) +
         wall_note(texts, fence);
}

// What comes to a standing fence, and what it needs by the runs without it, are counted apart.
std::string field_table(const Texts& texts, const Json& fields) {
  std::vector<std::vector<std::string>> rows;
  if (fields.is_array())
    for (const Json& f : fields)
      rows.push_back({range_text(texts, number_text(value_at(f, {"from_m"}), 3),
                                 number_text(value_at(f, {"to_m"}), 3)),
                      number_text(value_at(f, {"n"})),
                      number_text(value_at(f, {"energy_kj", "p95"})),
                      number_text(value_at(f, {"energy_kj", "max"})),
                      number_text(value_at(f, {"top_height_m", "max"}), 3),
                      number_text(value_at(f, {"storage_m3"})),
                      number_text(value_at(f, {"design", "arrivals"})),
                      needed_number(value_at(f, {"design", "required_capacity_kj"})),
                      needed_number(value_at(f, {"design", "required_height_m"})),
                      word_text(value_at(f, {"design", "smallest_class"})),
                      word_text(value_at(f, {"design", "verdict"}))});
  return html_table(texts.list("fences.field_heads"), rows,
                    {false, true, true, true, true, true, true, true, true}) +
         html_note(texts.of("fences.field_note"));
}

std::string comparison_table(const Texts& texts, const Json& comparison) {
  static const std::pair<const char*, const char*> rows[] = {
      {"blocks_behind_the_line", "fences.blocks_behind"},
      {"share_behind_the_line", "fences.share_behind"},
      {"volume_behind_the_line_m3_per_run", "fences.volume_behind"},
      {"energy_at_the_line_kj_p50", "fences.median_energy"},
      {"energy_at_the_line_kj_max", "fences.largest_energy"},
      {"mean_L_path_m", "fences.mean_length"},
      {"mean_reach_angle_path_deg", "fences.mean_angle"},
      {"mean_centre_of_mass_L_path_m", "fences.mean_centre"}};
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, name] : rows)
    table.push_back({texts.of(name), number_text(value_at(comparison, {"with", key})),
                     number_text(value_at(comparison, {"without", key})),
                     number_text(value_at(comparison, {"with_minus_without", key}))});
  return html_table(texts.list("fences.comparison_heads"), table, {false, true, true, true});
}

// Each fence in each case; where both are known what comes to its line without it.
std::string case_fence_table(const ReportData& data) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, report] : data.case_fences)
    for (const Json& fence : value_at(report, {"fences"})) {
      const Json open = value_at(fence, {"at_open_line"});
      const Json came = open.is_object() ? open : value_at(fence, {"whole"});
      rows.push_back({word_text(value_at(fence, {"name"})), xml_escaped(name),
                      number_text(value_at(came, {"n"})),
                      number_text(value_at(came, {"energy_kj", "p95"})),
                      number_text(value_at(came, {"energy_kj", "max"})),
                      number_text(value_at(came, {"top_height_m", "max"}), 3),
                      word_text(value_at(fence, {"design", "whole", "verdict"}))});
    }
  if (rows.empty()) return "";
  const Texts& texts = data.texts;
  return "<h3>" + texts.of("fences.by_case") + "</h3>\n" +
         html_table(texts.list("fences.case_heads"), rows,
                    {false, false, true, true, true, true, false}) +
         html_note(texts.of(value_at(data.runout, {"cases_weighed"}) == Json(true)
                                ? "fences.cases_weighed"
                                : "fences.cases_alike"));
}

}  // namespace

std::string fence_verdict(const Texts& texts, const Json& fence) {
  const Json design = value_at(fence, {"design", "whole"});
  const std::string verdict = word_text(value_at(design, {"verdict"}));
  const std::string kind = verdict == "meets" ? " pass" : verdict == "does not meet" ? " fail" : "";
  const Json capacity = value_at(fence, {"capacity_kj"});
  std::string out =
      "<div class=\"verdict" + kind + "\"><b>" +
      texts.of(
          "fences.verdict",
          {{"fence", word_text(value_at(fence, {"name"}))},
           {"code", fs::path(word_text(value_at(fence, {"design", "code"}))).stem().string()}}) +
      "</b>: " + word_text(value_at(design, {"text"}));
  if (verdict != "nothing came")
    out += ". " + texts.of(capacity.is_number() ? "fences.has_capacity" : "fences.has_no_capacity",
                           {{"height", number_text(value_at(fence, {"height_m"}), 3)},
                            {"capacity", number_text(capacity)},
                            {"basis", word_text(value_at(fence, {"design", "basis_text"}))}});
  if (number_text(value_at(fence, {"whole", "n"})) == "0")
    out += ". " + texts.of("fences.nothing_came", {{"verdicts", verdict_counts(texts, fence)}});
  return out + ".</div>\n";
}

std::string fence_verdicts(const ReportData& data) {
  std::string out;
  const Texts& texts = data.texts;
  const auto add = [&](const Json& report) {
    const Json fences = value_at(report, {"fences"});
    if (fences.is_array())
      for (const Json& fence : fences) out += fence_verdict(texts, fence);
  };
  if (data.case_fences.empty() || value_at(data.runout, {"cases_weighed"}) == Json(true)) {
    add(data.fence);
    return out;
  }
  for (const auto& [name, report] : data.case_fences) {
    out += "<h4>" + texts.of("words.case", {{"case", xml_escaped(name)}}) + "</h4>\n";
    add(report);
  }
  return out;
}

std::string fence_section(const ReportData& data) {
  if (!value_at(data.fence, {"fences"}).is_array()) return "";
  const Texts& texts = data.texts;
  std::string out = case_fence_table(data);
  for (const Json& fence : data.fence["fences"]) {
    out += "<h3>" +
           texts.of("fences.size", {{"fence", word_text(value_at(fence, {"name"}))},
                                    {"length", number_text(value_at(fence, {"length_m"}))},
                                    {"height", number_text(value_at(fence, {"height_m"}))}}) +
           "</h3>\n" + fence_verdict(texts, fence);
    out += derivation_table(texts, value_at(fence, {"design", "whole", "derivation"}));
    out += verdict_table(texts, value_at(fence, {"verdicts"})) + arrivals(texts, fence);
    out += html_fold(texts.of("fences.each_field"),
                     field_table(texts, value_at(fence, {"fields"})) + wall_note(texts, fence));
    if (!value_at(fence, {"comparison"}).is_null())
      out += "<h3>" + texts.of("fences.with_and_without") + "</h3>\n" +
             comparison_table(texts, value_at(fence, {"comparison"})) + wall_note(texts, fence);
    if (value_at(fence, {"notes"}).is_array())
      for (const Json& remark : fence["notes"]) out += html_note(word_text(remark));
    const Json guessed = value_at(fence, {"design", "from_memory"});
    if (guessed.is_array() && !guessed.empty()) {
      std::string list;
      for (const Json& name : guessed) list += (list.empty() ? "" : ", ") + word_text(name);
      out += html_note(texts.of("fences.from_memory", {{"numbers", list}}));
    }
  }
  for (const MapPicture& map : data.change_map)
    out += map_figure(texts, data.sheet, map, texts.of("fences.change"), "1",
                      texts.of("fences.change_caption"));
  return html_section("fences", texts.of("fences.title"), out);
}

}  // namespace talus
