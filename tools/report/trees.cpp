#include "tools/report/trees.hpp"

#include <algorithm>
#include <vector>

#include "report/html.hpp"
#include "tools/report/json.hpp"

namespace talus {
namespace {

std::string forest_table(const Texts& texts, const Json& forests) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& forest : forests) {
    std::vector<std::string> row = {word_text(value_at(forest, {"forest"}))};
    for (const char* key : {"n_runs", "stems", "hit", "broken", "work_kj"})
      row.push_back(number_text(value_at(forest, {key})));
    rows.push_back(row);
  }
  return html_table(texts.list("trees.forest_heads"), rows, {false, true, true, true, true, true});
}

std::string stem_table(const Texts& texts, const Json& stems) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& stem : stems) {
    std::vector<std::string> row = {
        word_text(value_at(stem, {"forest"})) + " " + number_text(value_at(stem, {"stem"})),
        word_text(value_at(stem, {"species"}))};
    row.push_back(number_text(value_at(stem, {"x_m"}), 9) + ", " +
                  number_text(value_at(stem, {"y_m"}), 9));
    for (const char* key : {"dbh_cm", "capacity_kj", "n_runs", "n_hits", "n_broken",
                            "largest_work_kj", "least_left_kj"})
      row.push_back(number_text(value_at(stem, {key}), 3));
    rows.push_back(row);
  }
  return html_table(texts.list("trees.stem_heads"), rows,
                    {false, false, false, true, true, true, true, true, true, true});
}

}  // namespace

std::string tree_section(const ReportData& data) {
  const Json forests = value_at(data.runout, {"trees", "forests"});
  const Json stems = value_at(data.runout, {"trees", "stems"});
  if (!forests.is_array() || forests.empty()) return "";
  const Texts& texts = data.texts;
  std::string out = forest_table(texts, forests);
  const bool one_by_one = std::any_of(forests.begin(), forests.end(),
                                      [](const Json& f) { return f.contains("n_rocks"); });
  if (!stems.is_array() || stems.empty()) {
    out += html_paragraph(texts.of("trees.none_hit"));
  } else {
    const std::string n = number_text(value_at(data.runout, {"trees", "n_stems_hit"}));
    out +=
        html_fold(texts.of("trees.most_hit", {{"shown", std::to_string(stems.size())}, {"all", n}}),
                  stem_table(texts, stems));
    out += html_note(texts.of(one_by_one ? "trees.note_one_by_one" : "trees.note"));
  }
  return html_section("trees", texts.of("trees.title"), out);
}

}  // namespace talus
