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
std::string verdict_counts(const Json& fence) {
  std::string out;
  const Json verdicts = value_at(fence, {"verdicts"});
  if (verdicts.is_object())
    for (const auto& [name, v] : verdicts.items())
      if (number_text(value_at(v, {"n"})) != "0")
        out += (out.empty() ? "" : ", ") + number_text(value_at(v, {"n"})) + " " +
               (name == "not_reached" ? "did not reach it" : xml_escaped(name));
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

std::string verdict_table(const Json& verdicts) {
  std::vector<std::vector<std::string>> rows;
  if (verdicts.is_object())
    for (const auto& [name, v] : verdicts.items()) {
      std::string label = name;
      std::replace(label.begin(), label.end(), '_', ' ');
      const bool bounded = value_at(v, {"low"}).is_number();
      rows.push_back({label, number_text(value_at(v, {"n"})), percent_text(value_at(v, {"share"})),
                      bounded ? percent_text(value_at(v, {"low"})) + " to " +
                                    percent_text(value_at(v, {"high"}))
                              : std::string("needs 10 runs")});
    }
  return html_table({"verdict", "blocks", "share of all", "95 % interval"}, rows,
                    {false, true, true, true});
}

std::string arrival_table(const Json& whole) {
  static const std::pair<const char*, const char*> rows[] = {
      {"energy_kj", "energy [kJ]"},
      {"translational_energy_kj", "energy of translation [kJ]"},
      {"top_height_m", "height of the top [m]"},
      {"speed_m_s", "speed [m/s]"}};
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, name] : rows) {
    std::vector<std::string> row = {name};
    for (const char* column : {"p50", "p90", "p95", "p95_hi", "p99", "max"})
      row.push_back(number_text(value_at(whole, {key, column})));
    table.push_back(row);
  }
  return html_table({"of the arrivals", "p50", "p90", "p95", "p95, upper bound", "p99", "largest"},
                    table, {false, true, true, true, true, true, true});
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

std::string derivation_table(const Json& steps) {
  std::vector<std::vector<std::string>> rows;
  if (steps.is_array())
    for (const Json& step : steps)
      rows.push_back({word_text(value_at(step, {"symbol"})), word_text(value_at(step, {"name"})),
                      (is_needed(step) ? needed_number(value_at(step, {"value"}))
                                       : number_text(value_at(step, {"value"}))) +
                          " " + word_text(value_at(step, {"unit"})),
                      word_text(value_at(step, {"source"}))});
  if (rows.empty()) return "";
  return "<h3>Derivation of the design values</h3>\n" +
         html_table({"", "", "value", "from"}, rows, {false, false, true, false});
}

// The line that stops nothing beside the touches of the standing fence: which of them is for
// design.
std::string arrival_tables(const Json& fence) {
  const Json open = value_at(fence, {"at_open_line"});
  const Json basis = value_at(fence, {"design", "basis"});
  const Json whole = value_at(fence, {"whole"});
  const bool came = number_text(value_at(whole, {"n"})) != "0";
  if (basis == "line that stops nothing") return came ? arrival_table(whole) : "";
  std::string out;
  if (open.is_object() && number_text(value_at(open, {"n"})) != "0")
    out += "<h3>At its line without the fence: for design</h3>\n" + arrival_table(open);
  if (came)
    out += "<h3>First touches of the standing fence: not for design</h3>\n" + arrival_table(whole);
  return out;
}

// Below every number that a rigid fence has made.
std::string wall_note(const Json& fence) {
  if (value_at(fence, {"capacity_kj"}).is_number() || !value_at(fence, {"standing"}).is_boolean() ||
      !value_at(fence, {"standing"}).get<bool>())
    return "";
  return html_note(
      "Without capacity_kj the fence is a rigid wall, which no net is: it stops what would break "
      "one.");
}

// What came to the fence, and what it holds.
std::string arrivals(const Json& fence) {
  const Json whole = value_at(fence, {"whole"}), kept = value_at(fence, {"kept_from_passing_m3"});
  const std::string held =
      "Volumes as they lie, with the gaps between piled blocks: the fence stopped " +
      number_text(value_at(fence, {"retained_m3"})) + " m&sup3;" +
      (kept.is_number()
           ? ", kept from passing, as the runs without it say, " + number_text(kept) + " m&sup3;"
           : std::string()) +
      ", storage behind the fence " + number_text(value_at(fence, {"storage_m3"})) + " m&sup3;.";
  if (number_text(value_at(whole, {"n"})) == "0")
    return arrival_tables(fence) + html_paragraph("Nothing came to the fence. " + held) +
           wall_note(fence);
  return arrival_tables(fence) +
         html_paragraph(
             "Arrivals: " + number_text(value_at(fence, {"arrivals", "first_touches"})) +
             " first touches of the fence, with what the block had before, and " +
             number_text(value_at(fence, {"arrivals", "crossings"})) +
             " crossings of its line. Most in a run: " +
             number_text(value_at(whole, {"most_hits_in_a_run"})) + "; within one second up to " +
             number_text(value_at(whole, {"hits_in_that_second"})) + " with " +
             number_text(value_at(whole, {"energy_in_one_second_kj"})) + " kJ together. " + held) +
         wall_note(fence);
}

// What comes to a standing fence, and what it needs by the runs without it, are counted apart.
std::string field_table(const Json& fields) {
  std::vector<std::vector<std::string>> rows;
  if (fields.is_array())
    for (const Json& f : fields)
      rows.push_back(
          {number_text(value_at(f, {"from_m"}), 3) + " to " + number_text(value_at(f, {"to_m"}), 3),
           number_text(value_at(f, {"n"})), number_text(value_at(f, {"energy_kj", "p95"})),
           number_text(value_at(f, {"energy_kj", "max"})),
           number_text(value_at(f, {"top_height_m", "max"}), 3),
           number_text(value_at(f, {"storage_m3"})),
           number_text(value_at(f, {"design", "arrivals"})),
           needed_number(value_at(f, {"design", "required_capacity_kj"})),
           needed_number(value_at(f, {"design", "required_height_m"})),
           word_text(value_at(f, {"design", "smallest_class"})),
           word_text(value_at(f, {"design", "verdict"}))});
  return html_table({"field [m]", "arrivals", "energy p95 [kJ]", "largest [kJ]", "top, largest [m]",
                     "storage [m&sup3;]", "arrivals for design", "capacity needed [kJ]",
                     "height needed [m]", "ETAG class", "verdict"},
                    rows, {false, true, true, true, true, true, true, true, true}) +
         html_note(
             "The first columns hold what came to the fence in these runs, the last five the "
             "design check by its own arrivals, with its verdict (\"nothing came\": none of "
             "them).");
}

std::string comparison_table(const Json& comparison) {
  static const std::pair<const char*, const char*> rows[] = {
      {"blocks_behind_the_line", "blocks behind the line"},
      {"share_behind_the_line", "share of all"},
      {"volume_behind_the_line_m3_per_run", "volume behind the line, a run [m&sup3;]"},
      {"energy_at_the_line_kj_p50", "energy at the line, p50 [kJ]"},
      {"energy_at_the_line_kj_max", "energy at the line, largest [kJ]"},
      {"mean_L_path_m", "L along the path, mean [m]"},
      {"mean_reach_angle_path_deg", "angle of reach, mean [deg]"},
      {"mean_centre_of_mass_L_path_m", "path of the centre of mass, mean [m]"}};
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, name] : rows)
    table.push_back({name, number_text(value_at(comparison, {"with", key})),
                     number_text(value_at(comparison, {"without", key})),
                     number_text(value_at(comparison, {"with_minus_without", key}))});
  return html_table({"", "with the fence", "without", "difference"}, table,
                    {false, true, true, true});
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
  return "<h3>Case by case</h3>\n" +
         html_table({"fence", "case", "arrivals", "energy p95 [kJ]", "largest [kJ]",
                     "top, largest [m]", "verdict"},
                    rows, {false, false, true, true, true, true, false}) +
         html_note(value_at(data.runout, {"cases_weighed"}) == Json(true)
                       ? "Below: the cases together, by their weights."
                       : "Below: the runs of all cases, each alike, which no verdict rests on.");
}

}  // namespace

std::string fence_verdict(const Json& fence) {
  const Json design = value_at(fence, {"design", "whole"});
  const std::string verdict = word_text(value_at(design, {"verdict"}));
  const std::string kind = verdict == "meets" ? " pass" : verdict == "does not meet" ? " fail" : "";
  const Json capacity = value_at(fence, {"capacity_kj"});
  std::string out = "<div class=\"verdict" + kind + "\"><b>fence " +
                    word_text(value_at(fence, {"name"})) + ", " +
                    fs::path(word_text(value_at(fence, {"design", "code"}))).stem().string() +
                    "</b>: " + word_text(value_at(design, {"text"}));
  if (verdict != "nothing came")
    out += ". It is " + number_text(value_at(fence, {"height_m"}), 3) + " m high and " +
           (capacity.is_number() ? "holds " + number_text(capacity) + " kJ"
                                 : "has no capacity given") +
           ". The check rests on " + word_text(value_at(fence, {"design", "basis_text"}));
  if (number_text(value_at(fence, {"whole", "n"})) == "0")
    out += ". In these runs nothing came to it (" + verdict_counts(fence) + ")";
  return out + ".</div>\n";
}

std::string fence_verdicts(const ReportData& data) {
  std::string out;
  const auto add = [&out](const Json& report) {
    const Json fences = value_at(report, {"fences"});
    if (fences.is_array())
      for (const Json& fence : fences) out += fence_verdict(fence);
  };
  if (data.case_fences.empty() || value_at(data.runout, {"cases_weighed"}) == Json(true)) {
    add(data.fence);
    return out;
  }
  for (const auto& [name, report] : data.case_fences) {
    out += "<h4>Case " + xml_escaped(name) + "</h4>\n";
    add(report);
  }
  return out;
}

std::string fence_section(const ReportData& data) {
  if (!value_at(data.fence, {"fences"}).is_array()) return "";
  std::string out = case_fence_table(data);
  for (const Json& fence : data.fence["fences"]) {
    out += "<h3>" + word_text(value_at(fence, {"name"})) + ": " +
           number_text(value_at(fence, {"length_m"})) + " m long, " +
           number_text(value_at(fence, {"height_m"})) + " m high</h3>\n" + fence_verdict(fence);
    out += derivation_table(value_at(fence, {"design", "whole", "derivation"}));
    out += verdict_table(value_at(fence, {"verdicts"})) + arrivals(fence);
    out += html_fold("Each field between two posts",
                     field_table(value_at(fence, {"fields"})) + wall_note(fence));
    if (!value_at(fence, {"comparison"}).is_null())
      out += "<h3>With and without</h3>\n" + comparison_table(value_at(fence, {"comparison"})) +
             wall_note(fence);
    if (value_at(fence, {"notes"}).is_array())
      for (const Json& remark : fence["notes"]) out += html_note(word_text(remark));
    const Json guessed = value_at(fence, {"design", "from_memory"});
    if (guessed.is_array() && !guessed.empty()) {
      std::string list;
      for (const Json& name : guessed) list += (list.empty() ? "" : ", ") + word_text(name);
      out += html_note(
          "These numbers of the design code have not been checked against its print; check "
          "them before use: " +
          list + ".");
    }
  }
  for (const MapPicture& map : data.change_map)
    out += map_figure(data.sheet, map, "change by the fence", "1",
                      "What the fence changes: with minus without. <code>change.tif</code>");
  return html_section("fences", "Fences", out);
}

}  // namespace talus
