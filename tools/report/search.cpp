#include "tools/report/search.hpp"

#include <algorithm>

#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

constexpr std::size_t most_rows = 12;  // of the curve

std::string bounded_percent(const Json& share, const Json& interval) {
  std::string out = percent_text(share);
  if (interval.is_array() && interval.size() == 2 && interval[0].is_number())
    out += " (" + percent_text(interval[0]) + " to " + percent_text(interval[1]) + ")";
  return out;
}

std::string sizes_of(const Json& option, const char* key, int digits) {
  std::string out;
  const Json fences = value_at(option, {"fences"});
  if (fences.is_array())
    for (const Json& fence : fences)
      out += (out.empty() ? "" : " + ") + number_text(value_at(fence, {key}), digits);
  return out;
}

std::vector<std::string> option_row(const std::string& name, const Json& option) {
  return {name,
          number_text(value_at(option, {"length_m"}), 3),
          sizes_of(option, "height_m", 2),
          sizes_of(option, "capacity_kj", 4),
          number_text(value_at(option, {"cost"}), 4),
          percent_text(value_at(option, {"stopped_share"})),
          bounded_percent(value_at(option, {"residual_run_share"}),
                          value_at(option, {"residual_interval"}))};
}

std::string proposal_table(const Json& proposals) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& proposal : proposals) {
    std::vector<std::string> row = option_row(word_text(value_at(proposal, {"name"})), proposal);
    const Json verified = value_at(proposal, {"verified"});
    row.push_back(verified.is_object() ? bounded_percent(value_at(verified, {"residual_run_share"}),
                                                         value_at(verified, {"residual_interval"}))
                                       : std::string("not verified"));
    row.push_back(verified.is_object() ? word_text(value_at(verified, {"comparison"})) : "");
    row.push_back(word_text(value_at(proposal, {"governs"})));
    rows.push_back(std::move(row));
  }
  return html_table({"fence", "length [m]", "height [m]", "class [kJ]", "cost", "hits stopped",
                     "runs that still hit it, predicted (95 %)",
                     "with the fence standing, other runs", "", "governs"},
                    rows, {false, true, true, true, true, true, true, true, false, false});
}

std::string curve_table(const Json& curve) {
  std::vector<std::vector<std::string>> rows;
  const std::size_t step = (curve.size() + most_rows - 1) / most_rows;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (i % step == 0 || i + 1 == curve.size())
      rows.push_back(option_row(std::to_string(i + 1), curve[i]));
  return html_table({"option", "length [m]", "height [m]", "class [kJ]", "cost", "hits stopped",
                     "runs that still hit it, predicted (95 %)"},
                    rows, {false, true, true, true, true, true, true});
}

std::string reach_cells(const ReportData& data) {
  for (const MapPicture& map : data.maps)
    if (map.name == "reach") return cells_image(data.sheet, map.cells);
  return "";
}

// Where the proposals stand, on the map of reach.
std::string proposal_map(const ReportData& data, const Json& proposals) {
  std::string paths;
  for (const Json& proposal : proposals) {
    const Json lines = value_at(proposal, {"lines"});
    if (!lines.is_array()) continue;
    for (const Json& line : lines) {
      std::vector<Vec2> posts;
      for (const Json& post : line.at("posts"))
        posts.emplace_back(Vec2(post[0].get<double>(), post[1].get<double>()) - data.sheet.origin);
      paths += "<path class=\"proposal\" d=\"" + sheet_path(data.sheet, posts, false) +
               "\"><title>" + word_text(value_at(line, {"name"})) + "</title></path>\n";
    }
  }
  if (paths.empty()) return "";
  return html_figure(sheet_svg(data.sheet, reach_cells(data) + paths, "where the proposals stand"),
                     "<span class=\"key\"><i class=\"proposal\"></i>proposed fence<i "
                     "class=\"fence\"></i>fence that stands<i "
                     "class=\"object\"></i>object</span>; in colour where blocks came.");
}

std::string search_text(const ReportData& data, const Json& search, const std::string& svg) {
  const std::string name = word_text(value_at(search, {"name"}));
  const bool is_fence = value_at(search, {"verdict"}) == "fence";
  std::string out = "<h3>" + name + "</h3>\n<div class=\"verdict\">" +
                    word_text(value_at(search, {"answer"})) + ".</div>\n";
  const Json proposals = value_at(search, {"proposals"}), curve = value_at(search, {"curve"});
  if (is_fence && proposals.is_array())
    out += proposal_table(proposals) + proposal_map(data, proposals);
  if (!svg.empty())
    out += html_figure(
        html_svg(svg, "cost against what is let through"),
        "Cost and the share of hits let through. <code>fence_search.gpkg</code> has the lines.");
  if (curve.is_array() && !curve.empty())
    out += html_fold("Most stopped for its cost", curve_table(curve));
  if (value_at(search, {"prices_given"}) == false)
    out += html_note(
        "No prices of classes are given: costs only rank. A metre costs 1, and 0.2 more for each "
        "class, " +
        number_text(value_at(search, {"price_per_m2"}), 3) + " for each metre of height.");
  return out;
}

}  // namespace

std::string search_section(const ReportData& data) {
  const Json searches = value_at(data.search, {"searches"});
  if (!searches.is_array() || searches.empty()) return "";
  std::string out;
  for (std::size_t s = 0; s < searches.size(); ++s)
    out += search_text(data, searches[s], s < data.search_svgs.size() ? data.search_svgs[s] : "");
  out += html_note(
      "Predicted shares rest on runs in which candidate lines stopped nothing, and fit these runs "
      "too well; verified ones on runs with other seeds in which the fence stood. A fence adds up "
      "the energies that a field takes.");
  return html_section("search", "Where a fence belongs", out);
}

}  // namespace talus
