#include "tools/report/objects.hpp"

#include <cmath>

#include "base/text.hpp"
#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

std::string whole_metres(const Json& value) {
  return value.is_number() ? text(std::round(value.get<double>()), 12) : number_text(value);
}

std::string interval_text(const Json& pair) {
  if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number()) return "";
  return " (" + percent_text(pair[0]) + " to " + percent_text(pair[1]) + ")";
}

// "320 (200 to 700)" years, of a frequency with its bounds; a dash where there is none.
std::string period_text(const Json& rate) {
  if (!rate.is_array() || rate.size() != 3 || !rate[0].is_number() || !(rate[0].get<double>() > 0))
    return "&ndash;";
  const auto years = [](const Json& r) {
    return r.is_number() && r.get<double>() > 0 ? text(1 / r.get<double>(), 3)
                                                : std::string("unbounded");
  };
  return years(rate[0]) + " (" + years(rate[2]) + " to " + years(rate[1]) + ")";
}

std::string object_table(const Json& objects) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& o : objects) {
    const Json p95 = value_at(o, {"ke_p95_kj"});
    rows.push_back({word_text(value_at(o, {"name"})), word_text(value_at(o, {"kind"})),
                    percent_text(value_at(o, {"run_share"})) +
                        interval_text(value_at(o, {"run_share_interval"})),
                    period_text(value_at(o, {"frequency_per_a"})),
                    number_text(value_at(o, {"hits_a_run"}), 3),
                    p95.is_number() ? number_text(p95, 3) : std::string("&ndash;"),
                    number_text(value_at(o, {"ke_max_kj"}), 3),
                    number_text(value_at(o, {"top_height_p95_m"}), 3),
                    number_text(value_at(o, {"first_arrival_s"}), 3),
                    number_text(value_at(o, {"deposited_m3_a_run"}), 3)});
  }
  return html_table(
      {"object", "", "runs that hit it (95 %)", "return period [a]", "blocks a run",
       "energy p95 [kJ]", "largest [kJ]", "top p95 [m]", "first after [s]", "left on it [m&sup3;]"},
      rows, {false, false, true, true, true, true, true, true, true, true});
}

// Where the hits come from, in words and as a table of the strongest source cells.
std::string where_to_act(const Json& object, const Json& cell_size) {
  const std::string name = word_text(value_at(object, {"name"}));
  const Json behind = value_at(object, {"n_sources_50_90_100"});
  const Json sources = value_at(object, {"sources"});
  std::string out = "<h3>" + name + ": where to act</h3>\n";
  if (!behind.is_array() || behind.size() != 3 || !sources.is_array() || sources.empty())
    return out + html_paragraph("No block of these runs hit it.");
  out += html_paragraph("Half of its hits come from " + number_text(behind[0]) +
                        ", nine tenths from " + number_text(behind[1]) + " of " +
                        number_text(behind[2]) + " source cells of " + number_text(cell_size) +
                        " m that hit it at all. Scaling or anchoring counts most in the first of "
                        "these, the strongest of all:");
  std::vector<std::vector<std::string>> rows;
  for (const Json& s : sources)
    rows.push_back({whole_metres(value_at(s, {"x_m"})) + ", " + whole_metres(value_at(s, {"y_m"})),
                    percent_text(value_at(s, {"share_of_hits"})),
                    percent_text(value_at(s, {"p_hit"})), number_text(value_at(s, {"n_hits"})),
                    number_text(value_at(s, {"ke_p95_kj"}), 3)});
  return out + html_table({"source cell, x, y [m]", "of the object's hits",
                           "of the cell's blocks hit it", "hits", "energy p95 [kJ]"},
                          rows, {false, true, true, true, true});
}

}  // namespace

std::string object_section(const ReportData& data) {
  const Json objects = value_at(data.trace, {"objects"});
  if (!objects.is_array() || objects.empty()) return "";
  std::string out = object_table(objects);
  bool any_by_cells = false;
  for (const Json& object : objects)
    any_by_cells = any_by_cells || word_text(value_at(object, {"method"})) != "recorded";
  if (any_by_cells)
    out += html_note(
        "Some runs did not watch the objects: their hits are counted by the cells that an object "
        "lies in, none too few and some too many, with the largest energy over these cells.");
  out += html_note(
      "A block hits an object when its footprint touches it in plan, also where it flies over it; "
      "energies and heights are those at the first touch. Objects stop nothing in the runs.");
  const Json cell_size = value_at(data.trace, {"source_cell_m"});
  for (const Json& object : objects) out += where_to_act(object, cell_size);
  out += html_note(
      "All source cells and links stand in <code>trace.gpkg</code> and <code>links.csv</code>, "
      "rasters in <code>sources/</code>.");
  return html_section("objects", "What endangers the objects, and where to act", out);
}

}  // namespace talus
