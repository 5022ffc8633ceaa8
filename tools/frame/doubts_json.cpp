// Doubts as JSON rows of a report, written and read back.
#include "tools/frame/doubts_json.hpp"

#include <array>
#include <map>
#include <utility>

namespace talus {
namespace {

constexpr std::int64_t most_rows = 100;
constexpr std::array text_fields = {
    std::pair("what", &Doubt::what), std::pair("found", &Doubt::found),
    std::pair("expected", &Doubt::expected), std::pair("hint", &Doubt::hint)};
constexpr std::array number_fields = {std::pair("value", &Doubt::value),
                                      std::pair("low", &Doubt::low),
                                      std::pair("high", &Doubt::high)};

Json row_of(const Doubt& doubt) {
  Json row = {{"state", text(doubt.state)}};
  const auto add = [&row](const char* name, const std::string& words) {
    if (!words.empty()) row[name] = words;
  };
  add("file", doubt.where.file);
  if (doubt.where.line > 0) row["line"] = doubt.where.line;
  add("item", doubt.where.item);
  for (const auto& [name, field] : text_fields) add(name, doubt.*field);
  if (doubt.n > 1) row["n"] = doubt.n;
  if (doubt.feature >= 0) row["feature"] = doubt.feature;
  for (const auto& [name, field] : number_fields)
    if (std::isfinite(doubt.*field)) row[name] = doubt.*field;
  for (const Vec3& at : doubt.at) {
    row["at"].push_back({at.x(), at.y()});
    if (!std::isnan(at.z())) row["at"].back().push_back(at.z());
  }
  return row;
}

// A value of a foreign file may be of any type.
std::string words_at(const Json& row, const char* name) {
  return row.contains(name) && row[name].is_string() ? row[name].get<std::string>() : "";
}
double number_in(const Json& value) {
  return value.is_number() ? value.get<double>() : Doubt::none;
}
std::int64_t whole_at(const Json& row, const char* name, std::int64_t otherwise) {
  return row.contains(name) && row[name].is_number_integer() ? row[name].get<std::int64_t>()
                                                             : otherwise;
}

Doubt doubt_of(const Json& row) {
  Doubt doubt;
  doubt.where = {words_at(row, "file"), static_cast<int>(whole_at(row, "line", 0)),
                 words_at(row, "item")};
  for (const auto& [name, field] : text_fields) doubt.*field = words_at(row, name);
  for (const auto& [name, field] : number_fields)
    if (row.contains(name)) doubt.*field = number_in(row[name]);
  doubt.n = whole_at(row, "n", 1);
  doubt.feature = whole_at(row, "feature", -1);
  for (const DoubtState state : {DoubtState::mended, DoubtState::accepted, DoubtState::refused})
    if (words_at(row, "state") == text(state)) doubt.state = state;
  if (!row.contains("at") || !row["at"].is_array()) return doubt;
  for (const Json& at : row["at"])
    if (at.is_array() && at.size() >= 2 && at[0].is_number() && at[1].is_number())
      doubt.at.emplace_back(number_in(at[0]), number_in(at[1]),
                            at.size() > 2 ? number_in(at[2]) : Doubt::none);
  return doubt;
}

}  // namespace

void add_doubts(const std::vector<Doubt>& doubts, Json& report) {
  Json rows = Json::array(), n = Json::object();
  std::map<std::pair<std::string, DoubtState>, std::pair<std::int64_t, std::size_t>> of_group;
  for (const Doubt& doubt : doubts) {
    const std::string kind = doubt.what.empty() ? "other" : doubt.what;
    n[kind] = n.value(kind, std::int64_t{0}) + doubt.n;
    auto& [n_rows, last] = of_group[{kind, doubt.state}];
    if (doubt.what.empty() || ++n_rows <= most_rows) {
      last = rows.size();
      rows.push_back(row_of(doubt));
    } else {
      rows[last]["n"] = rows[last].value("n", std::int64_t{1}) + doubt.n;
    }
  }
  report["n_doubts"] = n;
  report["doubts"] = rows;
}

std::vector<Doubt> doubts_of(const Json& report) {
  std::vector<Doubt> doubts;
  if (!report.is_object() || !report.contains("doubts") || !report["doubts"].is_array())
    return doubts;
  for (const Json& row : report["doubts"])
    if (row.is_object()) doubts.push_back(doubt_of(row));
  return doubts;
}

}  // namespace talus
