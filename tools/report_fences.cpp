#include "report_fences.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/text.hpp"
#include "report/html.hpp"
#include "report_json.hpp"

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

// What came to the fence, and what it holds.
std::string arrivals(const Json& fence) {
  const Json whole = value_at(fence, {"whole"}), kept = value_at(fence, {"kept_from_passing_m3"});
  const std::string held =
      "Volume that the fence stopped: " + number_text(value_at(fence, {"retained_m3"})) +
      " m&sup3;" +
      (kept.is_number()
           ? ", kept from passing, as the runs without it say: " + number_text(kept) + " m&sup3;"
           : std::string()) +
      ", storage behind the fence: " + number_text(value_at(fence, {"storage_m3"})) + " m&sup3;.";
  if (number_text(value_at(whole, {"n"})) == "0")
    return html_paragraph("Nothing came to the fence. " + held);
  return arrival_table(whole) +
         html_paragraph(
             "Arrivals: " + number_text(value_at(fence, {"arrivals", "first_touches"})) +
             " first touches of the fence, with what the block had before, and " +
             number_text(value_at(fence, {"arrivals", "crossings"})) +
             " crossings of its line. Most in a run: " +
             number_text(value_at(whole, {"most_hits_in_a_run"})) + "; within one second up to " +
             number_text(value_at(whole, {"hits_in_that_second"})) + " with " +
             number_text(value_at(whole, {"energy_in_one_second_kj"})) + " kJ together. " + held);
}

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
           number_text(value_at(f, {"design", "required_capacity_kj"})),
           number_text(value_at(f, {"design", "required_height_m"}), 3),
           word_text(value_at(f, {"design", "smallest_class"})),
           word_text(value_at(f, {"design", "governs"}))});
  return html_table(
      {"field [m]", "arrivals", "energy p95 [kJ]", "largest [kJ]", "top, largest [m]",
       "storage [m&sup3;]", "capacity needed [kJ]", "height needed [m]", "class", "governs"},
      rows, {false, true, true, true, true, true, true, true});
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
      {"mean_centre_of_mass_L_path_m", "way of the centre of mass, mean [m]"}};
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, name] : rows)
    table.push_back({name, number_text(value_at(comparison, {"with", key})),
                     number_text(value_at(comparison, {"without", key})),
                     number_text(value_at(comparison, {"with_minus_without", key}))});
  return html_table({"", "with the fence", "without", "difference"}, table,
                    {false, true, true, true});
}

}  // namespace

std::string fence_verdict(const Json& fence) {
  const Json design = value_at(fence, {"design", "whole"});
  const std::string name = "fence " + word_text(value_at(fence, {"name"}));
  if (number_text(value_at(fence, {"whole", "n"})) == "0")
    return "<div class=\"verdict\"><b>" + name + "</b>: nothing came to it (" +
           verdict_counts(fence) + ").</div>\n";
  std::string kind = "fail", outcome = " does not meet ";
  if (word_text(value_at(design, {"verdict"})) == "meets") kind = "pass", outcome = " meets ";
  if (word_text(value_at(design, {"verdict"})) == "energy not checked")
    kind = "", outcome = " is high enough, its energy is not checked, by ";
  std::string out = "<div class=\"verdict " + kind + "\"><b>" + name + outcome +
                    fs::path(word_text(value_at(fence, {"design", "code"}))).stem().string() +
                    "</b>: needs " + number_text(value_at(design, {"required_capacity_kj"})) +
                    " kJ (class: " + word_text(value_at(design, {"smallest_class"})) +
                    ") and a height of " + number_text(value_at(design, {"required_height_m"}), 3) +
                    " m; it is " + number_text(value_at(fence, {"height_m"}), 3) + " m high";
  const Json capacity = value_at(fence, {"capacity_kj"});
  out += capacity.is_number() ? ", holds " + number_text(capacity) + " kJ"
                              : ", has no capacity given: its energy is not checked";
  if (!number_text(value_at(design, {"enough_arrivals"})).starts_with("y"))
    out += ". Too few arrivals (" + number_text(value_at(fence, {"whole", "n"})) + " of " +
           number_text(value_at(design, {"arrivals_needed"})) +
           ") for the percentiles of the code: the largest values stand in for them";
  return out + ".</div>\n";
}

std::string fence_section(const ReportData& data) {
  if (!value_at(data.fence, {"fences"}).is_array()) return "";
  std::string out;
  for (const Json& fence : data.fence["fences"]) {
    out += "<h3>" + word_text(value_at(fence, {"name"})) + ": " +
           number_text(value_at(fence, {"length_m"})) + " m long, " +
           number_text(value_at(fence, {"height_m"})) + " m high</h3>\n" + fence_verdict(fence);
    out += verdict_table(value_at(fence, {"verdicts"})) + arrivals(fence);
    out += html_fold("Each field between two posts", field_table(value_at(fence, {"fields"})));
    if (!value_at(fence, {"comparison"}).is_null())
      out += "<h3>With and without</h3>\n" + comparison_table(value_at(fence, {"comparison"}));
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
  if (!data.change_png.empty())
    out += html_figure(html_png(data.change_png, "change by the fence"),
                       "What the fence changes: with minus without. <code>change.tif</code>");
  return html_section("fences", "Fences", out);
}

}  // namespace talus
