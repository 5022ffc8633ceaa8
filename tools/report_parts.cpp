#include "report_parts.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include "base/csv.hpp"
#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "report/chart.hpp"
#include "report/encode.hpp"
#include "report/plan_view.hpp"
#include "report/viewer_scene.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

// The value at a path of keys; null where any is missing.
Json at(const Json& json, std::initializer_list<const char*> keys) {
  const Json* here = &json;
  for (const char* key : keys) {
    if (!here->is_object() || !here->contains(key)) return nullptr;
    here = &(*here)[key];
  }
  return *here;
}

std::string number(const Json& value, int digits = 4) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (!value.is_number()) return "&ndash;";
  if (value.is_number_integer()) digits = 9;
  return grouped_text(value.get<double>(), digits);
}

std::string percent(const Json& value) {
  return value.is_number() ? text(100 * value.get<double>(), 3) + " %" : "&ndash;";
}

std::string words(const Json& value) {
  return value.is_string() ? xml_escaped(value.get<std::string>()) : "";
}

std::string section(const std::string& id, const std::string& title, const std::string& content) {
  return "<section id=\"" + id + "\"><h2>" + title + "</h2>\n" + content + "</section>\n";
}

std::string paragraph(const std::string& content) { return "<p>" + content + "</p>\n"; }
std::string note(const std::string& content) { return "<p class=\"note\">" + content + "</p>\n"; }

std::string folded(const std::string& summary, const std::string& content) {
  return "<details><summary>" + summary + "</summary>\n" + content + "</details>\n";
}

std::string fact(const std::string& value, const std::string& what) {
  return "<div><b>" + value + "</b><span>" + what + "</span></div>\n";
}

std::string figure(const std::string& picture, const std::string& caption) {
  return "<figure>" + picture + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string svg_image(const std::string& svg, const std::string& alt) {
  return "<img alt=\"" + alt + "\" src=\"" + data_address("image/svg+xml", svg) + "\">";
}

bool all_pass(const ReportData& data) {
  const bool finished = std::all_of(data.runs.begin(), data.runs.end(),
                                    [](const RunFile& run) { return run.info.status == "done"; });
  return finished && std::all_of(data.limits.begin(), data.limits.end(),
                                 [](const LimitOverRuns& limit) { return limit.n_failed == 0; });
}

// --- what came out -------------------------------------------------------------------------------

// "1 stopped, 56 did not reach it"
std::string verdict_counts(const Json& fence) {
  std::string out;
  const Json verdicts = at(fence, {"verdicts"});
  if (verdicts.is_object())
    for (const auto& [name, v] : verdicts.items())
      if (number(at(v, {"n"})) != "0")
        out += (out.empty() ? "" : ", ") + number(at(v, {"n"})) + " " +
               (name == "not_reached" ? "did not reach it" : xml_escaped(name));
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

std::string fence_verdict(const Json& fence) {
  const Json design = at(fence, {"design", "whole"});
  const std::string name = "fence " + words(at(fence, {"name"}));
  if (number(at(fence, {"whole", "n"})) == "0")
    return "<div class=\"verdict\"><b>" + name + "</b>: nothing came to it (" +
           verdict_counts(fence) + ").</div>\n";
  std::string kind = "fail", outcome = " does not meet ";
  if (words(at(design, {"verdict"})) == "meets") kind = "pass", outcome = " meets ";
  if (words(at(design, {"verdict"})) == "energy not checked")
    kind = "", outcome = " is high enough, its energy is not checked, by ";
  std::string out = "<div class=\"verdict " + kind + "\"><b>" + name + outcome +
                    xml_escaped(fs::path(words(at(fence, {"design", "code"}))).stem().string()) +
                    "</b>: needs " + number(at(design, {"required_capacity_kj"})) +
                    " kJ (class: " + words(at(design, {"smallest_class"})) + ") and a height of " +
                    number(at(design, {"required_height_m"}), 3) + " m; it is " +
                    number(at(fence, {"height_m"}), 3) + " m high";
  const Json capacity = at(fence, {"capacity_kj"});
  out += capacity.is_number() ? ", holds " + number(capacity) + " kJ"
                              : ", has no capacity given: its energy is not checked";
  if (!number(at(design, {"enough_arrivals"})).starts_with("y"))
    out += ". Too few arrivals (" + number(at(fence, {"whole", "n"})) + " of " +
           number(at(design, {"arrivals_needed"})) +
           ") for the percentiles of the code: the largest values stand in for them";
  return out + ".</div>\n";
}

std::string summary(const ReportData& data) {
  const Json& r = data.runout;
  const auto mean = [&r](const char* key) { return at(r, {"spread_over_runs", key, "mean"}); };
  double fastest = 0, way = 0;  // of any block; of the centre of mass, mean of the runs
  if (at(r, {"runs"}).is_array())
    for (const Json& run : r["runs"]) {
      if (at(run, {"max_speed_m_s"}).is_number())
        fastest = std::max(fastest, run["max_speed_m_s"].get<double>());
      if (const Json length = at(run, {"centre_of_mass", "L_path_m"}); length.is_number())
        way += length.get<double>() / static_cast<double>(r["runs"].size());
    }
  const std::size_t n = data.runs.size();
  std::string out = "<div class=\"facts\">\n";
  out += fact(std::to_string(n), n == 1 ? "run" : "runs");
  out += fact(number(at(data.blocks, {"n_blocks"})), "blocks");
  out += fact(number(at(data.blocks, {"volume_m3"})) + " m&sup3;", "released rock");
  out += fact(number(mean("H_m")) + " m", "H, drop from the top to the farthest block");
  out += fact(number(mean("L_path_m")) + " m", "L, run-out of the farthest block along its path");
  out += fact(number(mean("reach_angle_path_deg"), 3) + "&deg;", "angle of reach, atan(H/L)");
  out += fact(grouped_text(way, 3) + " m", "way of the centre of mass of all blocks, in plan");
  out += fact(text(fastest, 3) + " m/s", "largest speed of a block");
  out += fact(number(at(r, {"swept_area_m2"})) + " m&sup2;", "swept area");
  out += "</div>\n";
  out += all_pass(data)
             ? "<div class=\"verdict pass\"><b>Health: pass.</b> All runs finished within their "
               "limits.</div>\n"
             : "<div class=\"verdict fail\"><b>Health: fail.</b> " +
                   words(at(r, {"tags", "HEALTH"})) +
                   ". The numbers below are shown to find the cause, not to be used; see <a "
                   "href=\"#health\">health</a>.</div>\n";
  if (at(data.fence, {"fences"}).is_array())
    for (const Json& fence : data.fence["fences"]) out += fence_verdict(fence);
  return section("result", "Result", out);
}

// --- maps ----------------------------------------------------------------------------------------

struct MapText {
  const char *name, *title, *caption;
};

constexpr MapText map_texts[] = {
    {"velocity", "Speed", "largest speed of a block's centroid while it was over the cell [m/s]"},
    {"ke_total", "Energy", "translation and rotation of one block at the same moment [kJ]"},
    {"ke_translational", "Energy of translation",
     "m v&sup2;/2 of one block, what barrier classes are tested with [kJ]"},
    {"pass_height_top", "Passing height, top",
     "highest corner of a block above the ground: a fence has to be taller [m]"},
    {"pass_height_centroid", "Passing height, centroid",
     "centroid of a block above the ground [m]"},
    {"reach", "Reach", "blocks that crossed the cell over all released blocks [1]"},
    {"exceedance", "Exceedance", "share of blocks above 30 and 300 kJ over the cell [1]"},
    {"deposit", "Deposit", "blocks at rest and their thickness over the cell"},
    {"arrival", "First arrival", "earliest time at which a block came over the cell [s]"},
    {"energy_line", "Energy line",
     "smallest angle from a block's start to the cell along its path [deg]"}};

// What stands between `name="` and the next quote.
std::string attribute(const std::string& xml, const std::string& name) {
  const std::size_t begin = xml.find(" " + name + "=\"");
  if (begin == std::string::npos) return "";
  const std::size_t first = begin + name.size() + 3;
  return xml.substr(first, xml.find('"', first) - first);
}

// The classes of a style in the page's own letters: those of a picture shrink with it.
std::string legend_of(const std::string& qml) {
  std::string out;
  for (std::size_t i = qml.find("<item "); i != std::string::npos; i = qml.find("<item ", i + 1)) {
    const std::string item = qml.substr(i, qml.find("/>", i) - i);
    if (attribute(item, "alpha") == "0") continue;
    out += "<span><i style=\"background:" + attribute(item, "color") + "\"></i>" +
           attribute(item, "label") + "</span> ";
  }
  return out.empty() ? "" : "<span class=\"legend\">" + out + "</span>";
}

std::string map_section(const ReportData& data) {
  std::string out =
      figure(plan_view_svg(data.shown, data.terrain, data.hillshade_png),
             "<span class=\"key\"><i class=\"start\"></i>start<i class=\"way\"></i>ways of the "
             "centroids<i class=\"end\"></i>end<i class=\"fence\"></i>fence line</span>. Run " +
                 xml_escaped(data.shown_name) + "; north is up.");
  out += paragraph(
      "Every cell counts a block once, with its largest value over all steps of the solver. Shares "
      "are parts of a sum over blocks, not over tons: " +
      words(at(data.runout, {"tags", "DENOMINATOR"})) +
      ". With few passages the maps show largest values, else the 95th percentile: the heading of "
      "the picture's legend says which (_max or _p95).");
  out += "<div class=\"maps\">\n";
  for (const MapText& map : map_texts) {
    const auto found = std::find_if(data.maps.begin(), data.maps.end(),
                                    [&map](const MapPicture& p) { return p.name == map.name; });
    if (found == data.maps.end()) continue;
    out += figure("<img loading=\"lazy\" alt=\"" + std::string(map.title) + "\" src=\"" +
                      data_address("image/png", found->png) + "\">",
                  "<b>" + std::string(map.title) + "</b>: " + map.caption + ". <code>maps/" +
                      map.name + ".tif</code>" + legend_of(found->qml));
  }
  return section("maps", "Maps", out + "</div>\n");
}

// --- run-out -------------------------------------------------------------------------------------

std::string spread_table(const Json& spread) {
  static const std::pair<const char*, const char*> rows[] = {
      {"H_m", "H, drop from top to toe [m]"},
      {"L_path_m", "L along the path [m]"},
      {"L_chord_m", "L straight [m]"},
      {"reach_angle_path_deg", "angle of reach, path [deg]"},
      {"reach_angle_chord_deg", "angle of reach, straight [deg]"},
      {"H_cm_over_L_cm", "H/L of the centre of mass [1]"}};
  // One run has no spread: its value stands alone.
  const bool one = number(at(spread, {"H_m", "n"})) == "1";
  std::vector<std::string> headings = {"quantity", "mean", "min", "p50", "p95", "max"};
  if (one) headings = {"quantity", "value"};
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, name] : rows) {
    std::vector<std::string> row = {name};
    for (std::size_t c = 1; c < headings.size(); ++c)
      row.push_back(number(at(spread, {key, one ? "mean" : headings[c].c_str()})));
    table.push_back(row);
  }
  return html_table(headings, table, {false, true, true, true, true, true}) +
         (one ? "" : note("Over the runs; p50: half of them lie below, p95: 95 in 100 lie below."));
}

std::string mobility_table(const Json& mobility) {
  std::vector<std::vector<std::string>> rows;
  if (mobility.is_array())
    for (const Json& relation : mobility) {
      const Json runs = at(relation, {"runs"});
      const Json first = runs.is_array() && !runs.empty() ? runs[0] : Json();
      const Json from_memory = at(relation, {"from_memory"});
      rows.push_back({words(at(relation, {"relation"})), words(at(relation, {"path"})),
                      number(at(first, {"L_expected_m"})),
                      number(at(first, {"L_over_expected"}), 3),
                      number(at(first, {"exceedance_probability"}), 2),
                      words(at(relation, {"source"})) +
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
  std::set<std::string> grounds;
  for (const RunFile& run : data.runs)
    for (const GroundSettings& ground : parse_site(run.info.config, run.info.run_id).grounds)
      grounds.insert(xml_escaped(ground.name) + ": tan " + text(ground.friction_deg, 4) +
                     "&deg; = " + text(std::tan(ground.friction_deg * std::numbers::pi / 180), 3));
  std::string list;
  for (const std::string& ground : grounds) list += (list.empty() ? "" : "; ") + ground;
  return paragraph(
      "A mass that only slides has H/L of its centre of mass equal to the tangent of "
      "the ground's friction angle (" +
      list + "); a hollow that holds it back, rolling and impacts move it away from that.");
}

std::string runout_section(const ReportData& data) {
  if (data.runout.is_null()) return "";
  const Json balance = at(data.runout, {"balance"});
  std::string out = spread_table(at(data.runout, {"spread_over_runs"})) + friction_paragraph(data);
  out +=
      paragraph("Volume: released " + number(at(balance, {"released_m3"})) + " m&sup3; = at rest " +
                number(at(balance, {"deposited_m3"})) + " + still moving " +
                number(at(balance, {"moving_m3"})) + " + left the terrain " +
                number(at(balance, {"left_domain_m3"})) + " (sum over the runs).");
  if (number(at(balance, {"n_moving"})) != "0")
    out += note(number(at(balance, {"n_moving"})) +
                " blocks still moved when the run ended: run-out is that of this moment. A longer "
                "[solver] duration_s lets them come to rest.");
  if (!data.mobility_svg.empty())
    out += figure(svg_image(data.mobility_svg, "H over L against volume"),
                  "Each run beside published relations of H/L and volume.");
  out += folded("Published relations", mobility_table(at(data.runout, {"mobility"})));
  return section("runout", "Run-out and mobility", out);
}

// --- fences --------------------------------------------------------------------------------------

std::string verdict_table(const Json& verdicts) {
  std::vector<std::vector<std::string>> rows;
  if (verdicts.is_object())
    for (const auto& [name, v] : verdicts.items()) {
      std::string label = name;
      std::replace(label.begin(), label.end(), '_', ' ');
      const bool bounded = at(v, {"low"}).is_number();
      rows.push_back({label, number(at(v, {"n"})), percent(at(v, {"share"})),
                      bounded ? percent(at(v, {"low"})) + " to " + percent(at(v, {"high"}))
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
      row.push_back(number(at(whole, {key, column})));
    table.push_back(row);
  }
  return html_table({"of the arrivals", "p50", "p90", "p95", "p95, upper bound", "p99", "largest"},
                    table, {false, true, true, true, true, true, true});
}

// What came to the fence, and what it holds.
std::string arrivals(const Json& fence) {
  const Json whole = at(fence, {"whole"}), kept = at(fence, {"kept_from_passing_m3"});
  const std::string held =
      "Volume that the fence stopped: " + number(at(fence, {"retained_m3"})) + " m&sup3;" +
      (kept.is_number()
           ? ", kept from passing, as the runs without it say: " + number(kept) + " m&sup3;"
           : std::string()) +
      ", storage behind the fence: " + number(at(fence, {"storage_m3"})) + " m&sup3;.";
  if (number(at(whole, {"n"})) == "0") return paragraph("Nothing came to the fence. " + held);
  return arrival_table(whole) +
         paragraph(
             "Arrivals: " + number(at(fence, {"arrivals", "first_touches"})) +
             " first touches of the fence, with what the block had before, and " +
             number(at(fence, {"arrivals", "crossings"})) +
             " crossings of its line. Most in a run: " + number(at(whole, {"most_hits_in_a_run"})) +
             "; within one second up to " + number(at(whole, {"hits_in_that_second"})) + " with " +
             number(at(whole, {"energy_in_one_second_kj"})) + " kJ together. " + held);
}

std::string field_table(const Json& fields) {
  std::vector<std::vector<std::string>> rows;
  if (fields.is_array())
    for (const Json& f : fields)
      rows.push_back(
          {number(at(f, {"from_m"}), 3) + " to " + number(at(f, {"to_m"}), 3), number(at(f, {"n"})),
           number(at(f, {"energy_kj", "p95"})), number(at(f, {"energy_kj", "max"})),
           number(at(f, {"top_height_m", "max"}), 3), number(at(f, {"storage_m3"})),
           number(at(f, {"design", "required_capacity_kj"})),
           number(at(f, {"design", "required_height_m"}), 3),
           words(at(f, {"design", "smallest_class"})), words(at(f, {"design", "governs"}))});
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
    table.push_back({name, number(at(comparison, {"with", key})),
                     number(at(comparison, {"without", key})),
                     number(at(comparison, {"with_minus_without", key}))});
  return html_table({"", "with the fence", "without", "difference"}, table,
                    {false, true, true, true});
}

std::string fence_section(const ReportData& data) {
  if (!at(data.fence, {"fences"}).is_array()) return "";
  std::string out;
  for (const Json& fence : data.fence["fences"]) {
    out += "<h3>" + words(at(fence, {"name"})) + ": " + number(at(fence, {"length_m"})) +
           " m long, " + number(at(fence, {"height_m"})) + " m high</h3>\n" + fence_verdict(fence);
    out += verdict_table(at(fence, {"verdicts"})) + arrivals(fence);
    out += folded("Each field between two posts", field_table(at(fence, {"fields"})));
    if (!at(fence, {"comparison"}).is_null())
      out += "<h3>With and without</h3>\n" + comparison_table(at(fence, {"comparison"}));
    if (at(fence, {"notes"}).is_array())
      for (const Json& remark : fence["notes"]) out += note(words(remark));
    const Json guessed = at(fence, {"design", "from_memory"});
    if (guessed.is_array() && !guessed.empty()) {
      std::string list;
      for (const Json& name : guessed) list += (list.empty() ? "" : ", ") + words(name);
      out += note(
          "These numbers of the design code have not been checked against its print; check "
          "them before use: " +
          list + ".");
    }
  }
  if (!data.change_png.empty())
    out += figure("<img loading=\"lazy\" alt=\"change by the fence\" src=\"" +
                      data_address("image/png", data.change_png) + "\">",
                  "What the fence changes: with minus without. <code>change.tif</code>");
  return section("fences", "Fences", out);
}

// --- curves --------------------------------------------------------------------------------------

std::string run_colour(std::size_t i) {
  static const char* const colours[] = {"#1f5fa8", "#c2491d", "#2f8a3c", "#7a4fa3",
                                        "#a8871c", "#1b8b8b", "#b03a73", "#5b6570"};
  return colours[i % 8];
}

// A column of the curves of each run against time.
Chart curve_chart(const CsvTable& table, const std::string& column, const std::string& title,
                  const std::string& unit) {
  Chart chart{title, "time [s]", unit, {}, false};
  std::map<std::string, std::size_t> place;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string& run = table.at(row, "run_id");
    const auto [found, is_new] = place.emplace(run, chart.series.size());
    if (is_new) chart.series.push_back({"", run_colour(place.size() - 1), {}, {}, 1.4});
    chart.series[found->second].x.push_back(table.number(row, "time_s"));
    chart.series[found->second].y.push_back(table.number(row, column));
  }
  return chart;
}

std::string curve_section(const ReportData& data) {
  if (data.curves_csv.empty()) return "";
  const CsvTable table = parse_csv(data.curves_csv, "curves.csv");
  std::string out = "<div class=\"charts\">\n";
  for (const auto& [column, title, unit] :
       {std::array{"max_speed_m_s", "Fastest block", "m/s"},
        std::array{"mean_speed_m_s", "Mean speed of the mass", "m/s"},
        std::array{"front_m", "Front: way of the block farthest ahead", "m"},
        std::array{"translational_energy_kj", "Kinetic energy of translation", "kJ"}})
    out += figure(chart_svg(curve_chart(table, column, title, unit)), "");
  out += "</div>\n" + note("A line a run. <code>curves.csv</code>");
  return section("curves", "Over time", out);
}

// --- health --------------------------------------------------------------------------------------

std::string limit_table(const ReportData& data) {
  std::vector<std::vector<std::string>> rows;
  for (const LimitOverRuns& limit : data.limits) {
    const bool pass = limit.n_failed == 0;
    rows.push_back({xml_escaped(limit.name), text(limit.worst, 4), text(limit.limit, 4),
                    std::to_string(limit.n_failed) + " of " + std::to_string(data.runs.size()),
                    pass ? "<b class=\"pass\">pass</b>" : "<b class=\"fail\">fail</b>"});
  }
  return html_table({"limit", "worst value", "limit", "runs beyond it", ""}, rows,
                    {false, true, true, true, false});
}

std::string counter_table(const ReportData& data) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    const RunFile& run = data.runs[i];
    HealthRow sum;
    double shortest = 0;
    for (const HealthRow& row : run.health) {
      sum.steps += row.steps;
      sum.passes += row.passes;
      sum.impacts += row.impacts;
      sum.unconverged += row.unconverged;
      sum.left_domain = row.left_domain;
      sum.deep = row.deep;
      sum.largest_penetration = std::max(sum.largest_penetration, row.largest_penetration);
      if (row.shortest_dt > 0 && (shortest == 0 || row.shortest_dt < shortest))
        shortest = row.shortest_dt;
    }
    rows.push_back({xml_escaped(data.run_names[i]), xml_escaped(run.info.status),
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

Chart health_chart(const ReportData& data, const std::string& title, const std::string& unit,
                   double HealthRow::*field, bool log_y) {
  Chart chart{title, "time [s]", unit, {}, log_y};
  for (std::size_t i = 0; i < data.runs.size(); ++i) {
    ChartSeries line{"", run_colour(i), {}, {}, 1.4};
    for (const HealthRow& row : data.runs[i].health) {
      line.x.push_back(row.time);
      line.y.push_back(row.*field);
    }
    chart.series.push_back(std::move(line));
  }
  return chart;
}

// Where the energy of the shown run is: adds up to what the fall, the start and the base gave.
Chart energy_chart(const RunFile& run) {
  Chart chart{"Energy balance", "time [s]", "MJ", {}, false};
  chart.series = {{"fallen", "#1c2126", {}, {}},
                  {"moving", "#1f5fa8", {}, {}},
                  {"friction", "#c2491d", {}, {}},
                  {"impacts", "#a8871c", {}, {}},
                  {"sum", "#2f8a3c", {}, {}, 3.2}};
  if (run.health.empty()) return chart;
  const HealthRow& first = run.health.front();
  const double start = first.translation + first.rotation + first.potential + first.elastic +
                       first.friction + first.impact + first.contact + first.removed - first.base;
  for (const HealthRow& row : run.health) {
    const double moving = row.translation + row.rotation + row.elastic;
    const double spent = row.friction + row.impact + row.contact + row.removed;
    const double values[] = {start - row.potential + row.base, moving, row.friction, row.impact,
                             moving + spent};
    for (std::size_t k = 0; k < chart.series.size(); ++k) {
      chart.series[k].x.push_back(row.time);
      chart.series[k].y.push_back(values[k] / 1e6);
    }
  }
  std::rotate(chart.series.begin(), chart.series.end() - 1, chart.series.end());
  return chart;
}

std::string health_section(const ReportData& data) {
  std::string out =
      all_pass(data)
          ? "<div class=\"verdict pass\"><b>Pass.</b> All runs finished within their "
            "limits.</div>\n"
          : "<div class=\"verdict fail\"><b>Fail.</b> A limit is broken or a run has not "
            "finished.</div>\n";
  out += data.limits.empty()
             ? note("The registry holds no record of these runs: limits cannot be shown.")
             : limit_table(data);
  for (std::size_t i = 0; i < data.runs.size(); ++i)
    if (const RunFile& run = data.runs[i]; !run.info.reason.empty())
      out +=
          note("Run " + xml_escaped(data.run_names[i]) + ": " + xml_escaped(run.info.reason) + ".");
  out += counter_table(data) + "<div class=\"charts\">\n";
  out += figure(chart_svg(energy_chart(data.shown)),
                "Run " + xml_escaped(data.shown_name) +
                    ": the sum of what moves and what was spent lies on what has fallen.");
  out += figure(chart_svg(health_chart(data, "Largest penetration in the interval", "m",
                                       &HealthRow::largest_penetration, true)),
                "");
  out += figure(chart_svg(health_chart(data, "Shortest time step in the interval", "s",
                                       &HealthRow::shortest_dt, true)),
                "A step ends at an impact, so steps may be very short without anything being "
                "wrong. Gaps: no step with a search for contacts.");
  return section("health", "Health certificate", out + "</div>\n");
}

// --- what was assumed ----------------------------------------------------------------------------

std::string plan_table(const ReportData& data) {
  const Json plan = Json::parse(data.shown.info.plan, nullptr, false);
  std::vector<std::vector<std::string>> rows;
  if (plan.is_array())
    for (const Json& item : plan)
      rows.push_back({words(at(item, {"item"})),
                      number(at(item, {"on"})) == "yes" ? "computed" : "left out",
                      words(at(item, {"reason"})), words(at(item, {"rule"}))});
  return html_table({"item", "", "because", "rule"}, rows);
}

std::string settings_table(const Site& site, bool defaults) {
  std::vector<std::vector<std::string>> rows;
  for (const EffectiveValue& value : effective_values(site)) {
    if (value.value.empty() || (value.source == "default") != defaults) continue;
    rows.push_back({"<code>" + xml_escaped(value.section + "." + value.key) + "</code>",
                    "<code>" + xml_escaped(value.value) + "</code>"});
  }
  return html_table({"key", "value"}, rows);
}

std::string sureness(const ReportData& data) {
  const std::size_t n = data.runs.size();
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"Runs", std::to_string(n) + (n < 10 ? ": fewer than 10 give no interval for "
                                                        "shares and percentiles of a mass that "
                                                        "moves together"
                                                      : ": intervals come from the bootstrap over "
                                                        "runs")});
  if (const Json rmse = at(data.trn, {"reference", "rmse_m"}); rmse.is_number())
    rows.push_back({"Terrain", "RMSE " + number(rmse, 3) + " m against " +
                                   words(at(data.trn, {"reference", "file"})) + ", largest " +
                                   number(at(data.trn, {"reference", "largest_m"}), 3) + " m"});
  else
    rows.push_back({"Terrain", "not compared with a better one (TRN_FLAGS = --reference DEM)"});
  rows.push_back({"Ground", number(at(data.trn, {"grid", "cell_size_m"})) +
                                " m cells: what is smaller, the run does not see"});
  if (const Json flat = at(data.tin, {"flat", "share_before"}); flat.is_number())
    rows.push_back({"Contours", "every " + number(at(data.tin, {"contours", "interval_m"})) +
                                    " m; flat triangles " + percent(flat) + " of the area, " +
                                    percent(at(data.tin, {"flat", "share_after"})) +
                                    " after mending"});
  if (const Json cut = at(data.blocks, {"cut"}); cut.is_object())
    rows.push_back({"Blocks", number(at(cut, {"n_slivers_merged"})) + " slivers (" +
                                  number(at(cut, {"slivers_merged_m3"})) +
                                  " m&sup3;) given to a neighbour; block volume " +
                                  number(at(cut, {"block_volume_m3"})) + " m&sup3; of " +
                                  number(at(cut, {"prism_volume_m3"})) + " m&sup3; of mass"});
  return html_table({"", "how sure"}, rows);
}

std::string assumption_section(const ReportData& data) {
  std::string out = sureness(data);
  out += paragraph(
      "Friction, restitution, joints and depth of the source are what the site file "
      "says; no run can tell whether they hold for this slope. Vary them (CASES of "
      "the pipeline) before anything is decided.");
  out += folded("Given in the site file", settings_table(data.site, false));
  out += folded("Defaults of the program", settings_table(data.site, true));
  if (!data.stereonet_svg.empty() || !data.sizes_svg.empty()) {
    out += "<div class=\"maps\">\n";
    if (!data.stereonet_svg.empty())
      out += figure(svg_image(data.stereonet_svg, "stereonet"), "Joint sets.");
    if (!data.sizes_svg.empty())
      out += figure(svg_image(data.sizes_svg, "block sizes"), "Sizes of the blocks.");
    out += "</div>\n";
  }
  return section("assumed", "What was assumed, and how sure it is", out);
}

std::string plan_section(const ReportData& data) {
  return section(
      "plan", "Scene plan",
      paragraph("What the scene needs was computed, and nothing else.") + plan_table(data));
}

// --- provenance ----------------------------------------------------------------------------------

// Below the site's folder as a relative path, else as it is.
std::string shown_path(const Site& site, const std::string& path) {
  const fs::path folder = fs::weakly_canonical(fs::absolute(fs::path(site.file)).parent_path());
  const fs::path relative = fs::path(path).lexically_relative(folder);
  return relative.empty() ? path : relative.string();
}

std::string file_list(const Site& site, const std::vector<RunArtifact>& files) {
  std::vector<std::string> lines;
  for (const RunArtifact& file : files)
    lines.push_back("<code>" + xml_escaped(shown_path(site, file.path)) + "</code> <code>" +
                    (file.sha256.empty() ? "not hashed" : file.sha256.substr(0, 12)) + "</code>");
  std::sort(lines.begin(), lines.end());
  std::string out;
  for (const std::string& line : lines) out += (out.empty() ? "" : "<br>") + line;
  return out;
}

std::string provenance_section(const ReportData& data) {
  std::vector<std::vector<std::string>> rows;
  for (const RunRecord& step : data.steps)
    rows.push_back({"<code>" + xml_escaped(bare_command(step.command_line)) + "</code>",
                    xml_escaped(step.version + " (" + step.git_commit + ")"),
                    "<code>" + xml_escaped(step.content_id) + "</code>",
                    file_list(data.site, step.inputs), file_list(data.site, step.outputs)});
  std::string out =
      rows.empty()
          ? note("The registry holds no record of these results.")
          : paragraph(
                "From the first files to the results, each file with the beginning of its "
                "SHA-256. <code>talus-runs trace FILE</code> prints the ancestry of one "
                "file, <code>talus-runs trace FILE --prov</code> as W3C PROV.") +
                folded(std::to_string(rows.size()) + " steps",
                       html_table({"command", "version", "run id", "read", "wrote"}, rows));
  return section("provenance", "Provenance", out);
}

// --- viewer and page -----------------------------------------------------------------------------

std::string viewer_section(const ReportData& data) {
  if (data.shown.frames.time.empty()) return "";
  return section(
      "animation", "Animation",
      paragraph("Run " + xml_escaped(data.shown_name) +
                (data.runs.size() > 1 ? ", the one of the farthest run-out." : ".") +
                " Drag to turn, right-drag or shift-drag to move, wheel to zoom, click a block.") +
          "<div id=\"viewer\"><p class=\"viewer-none\">The animation needs JavaScript; all results "
          "stand in the maps, tables and curves of this page.</p></div>\n");
}

std::string page_script(const ReportData& data, const std::string& viewer) {
  std::string out;
  if (!data.shown.frames.time.empty()) {
    std::vector<double> heights;
    for (const RecordLine& line : data.shown.lines) {
      double height = 0;
      for (const FenceSettings& fence : data.site.fences)
        if (line.name == fence.name || line.name.starts_with(fence.name + "."))
          height = fence.height_m;
      heights.push_back(height);
    }
    out += "<script type=\"application/json\" id=\"scene\">" +
           viewer_scene(data.shown, data.bed, heights) + "</script>\n<script>\n" + viewer +
           "\nwindow.talus = talusViewer(document.getElementById('viewer'), "
           "JSON.parse(document.getElementById('scene').textContent));\n</script>\n";
  }
  return out +
         "<script>\nconst changed = new Date(document.lastModified), two = (n) => "
         "String(n).padStart(2, '0');\ndocument.getElementById('written').textContent = "
         "`, file written ${changed.getFullYear()}-${two(changed.getMonth() + 1)}-"
         "${two(changed.getDate())} "
         "${two(changed.getHours())}:${two(changed.getMinutes())}`;\naddEventListener('beforeprint'"
         ", () => "
         "document.querySelectorAll('details').forEach((d) => { d.open = true; }));\n</script>\n";
}

std::string page_head(const ReportData& data, const std::string& style) {
  const SiteInfo& info = data.site.info;
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      xml_escaped(info.name) +
      ": rockslide hazard</title>\n<link rel=\"icon\" "
      "href=\"data:,\">\n<style>\n" +
      style + "</style>\n</head>\n<body>\n<header>\n<h1>" + xml_escaped(info.name) + "</h1>\n";
  if (!info.description.empty()) out += paragraph(xml_escaped(info.description));
  out += "<p class=\"soft\">Rockslide hazard report by Talus " + xml_escaped(data.version) +
         ", run id " + "<code>" + data.run_id + "</code>, " + words(at(data.trn, {"grid", "crs"})) +
         "<span id=\"written\"></span></p>\n<nav>";
  for (const auto& [id, title] : {std::pair{"result", "Result"},
                                  {"maps", "Maps"},
                                  {"animation", "Animation"},
                                  {"runout", "Run-out"},
                                  {"fences", "Fences"},
                                  {"curves", "Over time"},
                                  {"health", "Health"},
                                  {"assumed", "Assumptions"},
                                  {"plan", "Plan"},
                                  {"provenance", "Provenance"}})
    out += std::string("<a href=\"#") + id + "\">" + title + "</a>";
  return out + "</nav>\n</header>\n<main>\n";
}

}  // namespace

std::string bare_command(const std::string& command) {
  const std::size_t space = command.find(' ');
  const std::size_t slash = command.rfind('/', space);
  return slash == std::string::npos || slash > space ? command : command.substr(slash + 1);
}

std::string report_page(const ReportData& data, const std::string& script,
                        const std::string& style) {
  return page_head(data, style) + summary(data) + map_section(data) + viewer_section(data) +
         runout_section(data) + fence_section(data) + curve_section(data) + health_section(data) +
         assumption_section(data) + plan_section(data) + provenance_section(data) +
         "</main>\n<footer>Talus is free software (GPL-3.0-or-later), without any warranty. A "
         "model "
         "is not the slope: limits and assumptions stand in docs/limits.md.</footer>\n" +
         page_script(data, script) + "</body>\n</html>\n";
}

}  // namespace talus
