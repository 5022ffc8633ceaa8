#include "tools/report/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/text.hpp"
#include "draw/drawing.hpp"
#include "report/html.hpp"
#include "sampling/sensitivity.hpp"
#include "site/uncertainty.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

// --- what was drawn ----------------------------------------------------------------------------

std::string quantity_table(const Texts& texts, const Site& site) {
  std::vector<std::vector<std::string>> rows;
  for (const QuantitySettings& quantity : site.quantities)
    rows.push_back({"<code>" + xml_escaped(quantity.name) + "</code>",
                    xml_escaped(text_of(site, quantity)),
                    texts.of(is_rock(quantity) ? "uncertainty.cuts" : "uncertainty.moves")});
  return rows.empty() ? "" : html_table(texts.list("uncertainty.quantity_heads"), rows);
}

std::string masses_note(const Texts& texts, const Site& site) {
  const UncertaintySettings& u = site.uncertainty;
  if (u.rock_masses == 0) return texts.of("uncertainty.one_mass");
  return texts.of("uncertainty.masses", {{"n", std::to_string(u.rock_masses)}}) +
         (u.terrain_rmse_m > 0
              ? " " + texts.of("uncertainty.grounds", {{"rmse", text(u.terrain_rmse_m, 3)}})
              : "");
}

// The runs with what they drew; all stand in runs.csv.
std::string drawn_table(const Texts& texts, const Json& runout) {
  constexpr std::size_t most = 200;
  const Json runs = value_at(runout, {"runs"});
  std::vector<std::string> headings, quantities;
  std::vector<std::vector<std::string>> rows;
  if (!runs.is_array()) return "";
  for (const Json& run : runs) {
    const Json drawn = value_at(run, {"drawn"});
    if (!drawn.is_object() || !drawn.contains("sample")) continue;
    if (headings.empty()) {
      headings = texts.list("uncertainty.drawn_heads");
      for (const auto& [name, value] : drawn.items()) {
        quantities.push_back(name);
        headings.push_back(xml_escaped(name));
      }
    }
    if (rows.size() == most) break;
    std::vector<std::string> row = {number_text(value_at(run, {"seed"})),
                                    number_text(value_at(run, {"event", "L_path_m"}))};
    for (const std::string& name : quantities)
      row.push_back(number_text(value_at(drawn, {name.c_str()})));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return "";
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a[0].size() != b[0].size() ? a[0].size() < b[0].size() : a[0] < b[0];
  });
  const std::string note =
      runs.size() > rows.size()
          ? html_note(texts.of("uncertainty.drawn_note", {{"n", std::to_string(rows.size())},
                                                          {"all", std::to_string(runs.size())}}))
          : "";
  return html_fold(texts.of("uncertainty.drawn"),
                   html_table(headings, rows, std::vector<bool>(headings.size(), true)) + note);
}

// --- sensitivity -------------------------------------------------------------------------------

struct Bar {
  std::string name;
  double value = 0;
};

// Bars from a line at 0, as far as -1 and 1 in each direction that there is.
Drawing bars_drawing(const std::vector<Bar>& bars, const std::string& title,
                     const std::string& alt) {
  constexpr double row = 22, top = 26, label = 250, width = 640, right = 50;
  const double height = top + row * static_cast<double>(bars.size()) + 6;
  const auto draw = [=](Pen& pen) {
    const Letters letters{12};
    double low = 0;
    for (const Bar& bar : bars) low = std::min(low, bar.value);
    low = low < -0.02 ? -1 : 0;
    const double scale = (width - label - right) / (1 - low), zero = label - low * scale;
    pen.words_about({0, 10}, title, letters, Anchor::begin);
    double y = top;
    for (const Bar& bar : bars) {
      const double end = zero + std::clamp(bar.value, low, 1.0) * scale;
      const double from = std::min(zero, end), to = std::max(zero, end);
      pen.words_about({label - 8, y + row / 2}, bar.name, letters, Anchor::end);
      pen.box({from, y + 4, std::max(1.0, to - from), row - 8},
              rgb(bar.value < 0 ? 0xb5533c : 0x2f6f9f));
      pen.words_about({to + 6, y + row / 2}, text(bar.value, 2), letters, Anchor::begin);
      y += row;
    }
    pen.line({{zero, top}, {zero, height - 4}}, {1});
  };
  return {width, height, alt, pixel_mm, draw};
}

// "L_path_m" in words.
std::string result_words(const Texts& texts, const std::string& result) {
  static const std::map<std::string, std::string> words = {
      {"L_path_m", "uncertainty.length"},
      {"reach_angle_path_deg", "uncertainty.angle"},
      {"L95_m", "uncertainty.length_95"},
      {"share_moved_1_m", "uncertainty.moved"}};
  if (const auto found = words.find(result); found != words.end()) return texts.of(found->second);
  const std::size_t dot = result.find('.');
  const std::string line = result.substr(dot + 1);
  return texts.of(
      result.starts_with("crossed.") ? "uncertainty.crossed" : "uncertainty.largest_energy",
      {{"line", line}});
}

// The rows of one result: a table, and a picture with both numbers.
std::string result_part(const Texts& texts, const std::string& result,
                        const std::vector<Json>& rows) {
  const bool is_enough = std::any_of(rows.begin(), rows.end(), [](const Json& row) {
    return value_at(row, {"first_order"}).is_number();
  });
  const std::string title = result_words(texts, result);
  if (!is_enough)
    return html_note(texts.of("uncertainty.too_few_runs",
                              {{"result", xml_escaped(title)},
                               {"n", number_text(value_at(rows[0], {"n_runs"}))},
                               {"needed", std::to_string(least_runs_for_sensitivity)}}));
  std::vector<Bar> shares, correlations;
  std::vector<std::vector<std::string>> table;
  for (const Json& row : rows) {
    const std::string name = value_at(row, {"quantity"}).get<std::string>();
    const Json share = value_at(row, {"first_order"}), rank = value_at(row, {"rank_correlation"});
    if (share.is_number()) shares.push_back({name, share.get<double>()});
    if (rank.is_number()) correlations.push_back({name, rank.get<double>()});
    table.push_back({"<code>" + xml_escaped(name) + "</code>", number_text(share, 2),
                     number_text(rank, 2), number_text(value_at(row, {"n_runs"}))});
  }
  return "<h3>" + xml_escaped(title) + "</h3>\n" +
         html_table(texts.list("uncertainty.index_heads"), table, {false, true, true, true}) +
         html_figure(svg_of(bars_drawing(shares, texts.of("uncertainty.shares"),
                                         texts.of("uncertainty.share_picture")),
                            "bars") +
                         (correlations.empty()
                              ? ""
                              : svg_of(bars_drawing(correlations, texts.of("uncertainty.ranks"),
                                                    texts.of("uncertainty.rank_picture")),
                                       "bars")),
                     xml_escaped(title) + ".");
}

std::string sensitivity_part(const Texts& texts, const Json& runout) {
  const Json list = value_at(runout, {"sensitivity"});
  if (!list.is_array() || list.empty()) return "";
  std::vector<std::pair<std::string, std::vector<Json>>> by_result;
  for (const Json& row : list) {
    const std::string result = value_at(row, {"result"}).get<std::string>();
    if (by_result.empty() || by_result.back().first != result) by_result.push_back({result, {}});
    by_result.back().second.push_back(row);
  }
  std::string out = "<h3>" + texts.of("uncertainty.sensitivity") + "</h3>\n";
  for (const auto& [result, rows] : by_result) out += result_part(texts, result, rows);
  return out + html_note(texts.of("uncertainty.note"));
}

// --- places ------------------------------------------------------------------------------------

std::string place_table(const Texts& texts, const Json& places) {
  std::vector<std::vector<std::string>> rows;
  if (const Json list = value_at(places, {"places"}); list.is_array())
    for (const Json& place : list) {
      const Json low = value_at(place, {"share_low"}), high = value_at(place, {"share_high"});
      rows.push_back(
          {word_text(value_at(place, {"place"})),
           percent_text(value_at(place, {"share_of_blocks"})),
           low.is_number() ? range_text(texts, percent_text(low), percent_text(high)) : "-",
           percent_text(value_at(place, {"share_of_runs"})),
           number_text(value_at(place, {"half_width"}), 2),
           number_text(value_at(place, {"wanted_half_width"}), 2),
           number_text(value_at(place, {"runs_to_add"}))});
    }
  if (rows.empty()) return "";
  return "<h3>" + texts.of("uncertainty.places") + "</h3>\n" +
         html_table(texts.list("uncertainty.place_heads"), rows,
                    {false, true, true, true, true, true, true});
}

}  // namespace

std::string uncertainty_section(const ReportData& data) {
  const Texts& texts = data.texts;
  const std::string places = place_table(texts, data.places);
  const bool is_drawn = !data.site.quantities.empty() || data.site.uncertainty.rock_masses > 0;
  const std::string sensitivity = sensitivity_part(texts, data.runout);
  if (!is_drawn && places.empty() && sensitivity.empty()) return "";
  std::string out = quantity_table(texts, data.site);
  if (is_drawn) out += html_paragraph(masses_note(texts, data.site));
  out += drawn_table(texts, data.runout) + places + sensitivity;
  return html_section("uncertainty", texts.of("uncertainty.title"), out);
}

}  // namespace talus
