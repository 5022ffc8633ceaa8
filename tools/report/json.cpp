#include "tools/report/json.hpp"

#include "base/text.hpp"
#include "base/words.hpp"

namespace talus {

Json value_at(const Json& json, std::initializer_list<const char*> keys) {
  const Json* here = &json;
  for (const char* key : keys) {
    if (!here->is_object() || !here->contains(key)) return nullptr;
    here = &(*here)[key];
  }
  return *here;
}

std::string number_text(const Json& value, int digits) {
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (!value.is_number()) return "&ndash;";
  if (value.is_number_integer()) digits = 9;
  return grouped_text(value.get<double>(), digits);
}

std::string percent_text(const Json& value) {
  return value.is_number() ? percent(value.get<double>()) : "&ndash;";
}

std::string range_text(const Texts& texts, const std::string& low, const std::string& high) {
  return texts.of("words.range", {{"low", low}, {"high", high}});
}

std::string runs_text(const Texts& texts, std::int64_t n) {
  return texts.counted(n, "words.run", "words.runs");
}

std::string word_text(const Json& value) {
  return value.is_string() ? xml_escaped(value.get<std::string>()) : "";
}

}  // namespace talus
