#include "tools/report/search.hpp"

#include <algorithm>

#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

constexpr std::size_t most_rows = 12;  // of the curve

std::string bounded_percent(const Texts& texts, const Json& share, const Json& interval) {
  std::string out = percent_text(share);
  if (interval.is_array() && interval.size() == 2 && interval[0].is_number())
    out += " (" + range_text(texts, percent_text(interval[0]), percent_text(interval[1])) + ")";
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

std::vector<std::string> option_row(const Texts& texts, const std::string& name,
                                    const Json& option) {
  return {name,
          number_text(value_at(option, {"length_m"}), 3),
          sizes_of(option, "height_m", 2),
          sizes_of(option, "capacity_kj", 4),
          number_text(value_at(option, {"cost"}), 4),
          percent_text(value_at(option, {"stopped_share"})),
          bounded_percent(texts, value_at(option, {"residual_run_share"}),
                          value_at(option, {"residual_interval"}))};
}

std::string proposal_table(const Texts& texts, const Json& proposals) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& proposal : proposals) {
    std::vector<std::string> row =
        option_row(texts, word_text(value_at(proposal, {"name"})), proposal);
    const Json verified = value_at(proposal, {"verified"});
    row.push_back(verified.is_object()
                      ? bounded_percent(texts, value_at(verified, {"residual_run_share"}),
                                        value_at(verified, {"residual_interval"}))
                      : texts.of("search.not_verified"));
    row.push_back(verified.is_object() ? word_text(value_at(verified, {"comparison"})) : "");
    row.push_back(word_text(value_at(proposal, {"governs"})));
    rows.push_back(std::move(row));
  }
  return html_table(texts.list("search.proposal_heads"), rows,
                    {false, true, true, true, true, true, true, true, false, false});
}

std::string curve_table(const Texts& texts, const Json& curve) {
  std::vector<std::vector<std::string>> rows;
  const std::size_t step = (curve.size() + most_rows - 1) / most_rows;
  for (std::size_t i = 0; i < curve.size(); ++i)
    if (i % step == 0 || i + 1 == curve.size())
      rows.push_back(option_row(texts, std::to_string(i + 1), curve[i]));
  return html_table(texts.list("search.curve_heads"), rows,
                    {false, true, true, true, true, true, true});
}

std::string reach_cells(const ReportData& data) {
  for (const MapPicture& map : data.maps)
    if (map.name == "reach") return cells_group(data.sheet, map.map.cells);
  return "";
}

// Where the proposals stand, on the map of reach.
std::string proposal_map(const ReportData& data, const Json& proposals) {
  std::vector<std::pair<std::string, std::vector<Vec2>>> fences;
  for (const Json& proposal : proposals) {
    const Json lines = value_at(proposal, {"lines"});
    if (!lines.is_array()) continue;
    for (const Json& line : lines) {
      fences.emplace_back(value_at(line, {"name"}).get<std::string>(), std::vector<Vec2>{});
      for (const Json& post : line.at("posts"))
        fences.back().second.emplace_back(Vec2(post[0].get<double>(), post[1].get<double>()) -
                                          data.sheet.origin);
    }
  }
  if (fences.empty()) return "";
  const std::string paths =
      sheet_group(data.sheet, "class=\"proposal\"", [&fences](Pen& pen, const MapSpot& spot) {
        for (const auto& [name, posts] : fences) {
          pen.line(on_map(spot, posts), {1.3, rgb(0xc8102e)});
          pen.note(name, {on_map(spot, posts)}, false);
        }
      });
  const Texts& texts = data.texts;
  return html_figure(sheet_svg(data.sheet, reach_cells(data) + paths, texts.of("search.map")),
                     "<span class=\"key\"><i class=\"proposal\"></i>" +
                         texts.of("search.proposed") + "<i class=\"fence\"></i>" +
                         texts.of("search.standing") + "<i class=\"object\"></i>" +
                         texts.of("search.object") + "</span>" + texts.of("search.colours"));
}

std::string search_text(const ReportData& data, const Json& search, const std::string& svg) {
  const std::string name = word_text(value_at(search, {"name"}));
  const bool is_fence = value_at(search, {"verdict"}) == "fence";
  const Texts& texts = data.texts;
  std::string out = "<h3>" + name + "</h3>\n<div class=\"verdict\">" +
                    word_text(value_at(search, {"answer"})) + ".</div>\n";
  const Json proposals = value_at(search, {"proposals"}), curve = value_at(search, {"curve"});
  if (is_fence && proposals.is_array())
    out += proposal_table(texts, proposals) + proposal_map(data, proposals);
  if (!svg.empty())
    out += html_figure(html_svg(svg, texts.of("search.chart")), texts.of("search.chart_caption"));
  if (curve.is_array() && !curve.empty())
    out += html_fold(texts.of("search.curve"), curve_table(texts, curve));
  if (value_at(search, {"prices_given"}) == false)
    out += html_note(texts.of("search.no_prices",
                              {{"price", number_text(value_at(search, {"price_per_m2"}), 3)}}));
  return out;
}

}  // namespace

std::string search_section(const ReportData& data) {
  const Json searches = value_at(data.search, {"searches"});
  if (!searches.is_array() || searches.empty()) return "";
  std::string out;
  for (std::size_t s = 0; s < searches.size(); ++s)
    out += search_text(data, searches[s], s < data.search_svgs.size() ? data.search_svgs[s] : "");
  out += html_note(data.texts.of("search.note"));
  return html_section("search", data.texts.of("search.title"), out);
}

}  // namespace talus
