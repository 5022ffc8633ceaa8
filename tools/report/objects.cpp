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

std::string interval_text(const Texts& texts, const Json& pair) {
  if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number()) return "";
  return " (" + range_text(texts, percent_text(pair[0]), percent_text(pair[1])) + ")";
}

// "320 (200 to 700)" years, of a frequency with its bounds; a dash where there is none.
std::string period_text(const Texts& texts, const Json& rate) {
  if (!rate.is_array() || rate.size() != 3 || !rate[0].is_number() || !(rate[0].get<double>() > 0))
    return "&ndash;";
  const auto years = [&texts](const Json& r) {
    return r.is_number() && r.get<double>() > 0 ? text(1 / r.get<double>(), 3)
                                                : texts.of("objects.unbounded");
  };
  return years(rate[0]) + " (" + range_text(texts, years(rate[2]), years(rate[1])) + ")";
}

std::string object_table(const Texts& texts, const Json& objects) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& o : objects) {
    const Json p95 = value_at(o, {"ke_p95_kj"});
    rows.push_back({word_text(value_at(o, {"name"})), word_text(value_at(o, {"kind"})),
                    percent_text(value_at(o, {"run_share"})) +
                        interval_text(texts, value_at(o, {"run_share_interval"})),
                    period_text(texts, value_at(o, {"frequency_per_a"})),
                    number_text(value_at(o, {"hits_a_run"}), 3),
                    p95.is_number() ? number_text(p95, 3) : std::string("&ndash;"),
                    number_text(value_at(o, {"ke_max_kj"}), 3),
                    number_text(value_at(o, {"top_height_p95_m"}), 3),
                    number_text(value_at(o, {"first_arrival_s"}), 3),
                    number_text(value_at(o, {"deposited_m3_a_run"}), 3)});
  }
  return html_table(texts.list("objects.heads"), rows,
                    {false, false, true, true, true, true, true, true, true, true});
}

// Where the hits come from, in words and as a table of the strongest source cells.
std::string where_to_act(const Texts& texts, const Json& object, const Json& cell_size) {
  const std::string name = word_text(value_at(object, {"name"}));
  const Json behind = value_at(object, {"n_sources_50_90_100"});
  const Json sources = value_at(object, {"sources"});
  std::string out = "<h3>" + texts.of("objects.where_to_act", {{"object", name}}) + "</h3>\n";
  if (!behind.is_array() || behind.size() != 3 || !sources.is_array() || sources.empty())
    return out + html_paragraph(texts.of("objects.none_hit"));
  out += html_paragraph(texts.of("objects.sources", {{"half", number_text(behind[0])},
                                                     {"nine_tenths", number_text(behind[1])},
                                                     {"all", number_text(behind[2])},
                                                     {"size", number_text(cell_size)}}));
  std::vector<std::vector<std::string>> rows;
  for (const Json& s : sources)
    rows.push_back({whole_metres(value_at(s, {"x_m"})) + ", " + whole_metres(value_at(s, {"y_m"})),
                    percent_text(value_at(s, {"share_of_hits"})),
                    percent_text(value_at(s, {"p_hit"})), number_text(value_at(s, {"n_hits"})),
                    number_text(value_at(s, {"ke_p95_kj"}), 3)});
  return out +
         html_table(texts.list("objects.source_heads"), rows, {false, true, true, true, true});
}

}  // namespace

std::string object_section(const ReportData& data) {
  const Json objects = value_at(data.trace, {"objects"});
  if (!objects.is_array() || objects.empty()) return "";
  const Texts& texts = data.texts;
  std::string out = object_table(texts, objects);
  bool any_by_cells = false;
  for (const Json& object : objects)
    any_by_cells = any_by_cells || word_text(value_at(object, {"method"})) != "recorded";
  if (any_by_cells) out += html_note(texts.of("objects.by_cells"));
  out += html_note(texts.of("objects.what_hits"));
  const Json cell_size = value_at(data.trace, {"source_cell_m"});
  for (const Json& object : objects) out += where_to_act(texts, object, cell_size);
  out += html_note(texts.of("objects.files"));
  return html_section("objects", texts.of("objects.title"), out);
}

}  // namespace talus
