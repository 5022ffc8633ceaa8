// base/json.hpp as text: reads and writes it by nlohmann's library, in this source alone.
#include "base/json.hpp"

#include <nlohmann/json.hpp>

namespace talus {

struct JsonText {
  using Library = nlohmann::ordered_json;

  static Library to_library(const Json& json) {
    if (json.is_object()) {
      Library out = Library::object();
      const auto& [keys, values] = std::get<Json::Object>(json.value_);
      for (std::size_t i = 0; i < keys.size(); ++i) out[keys[i]] = to_library(values[i]);
      return out;
    }
    if (json.is_array()) {
      Library out = Library::array();
      for (const Json& value : json) out.push_back(to_library(value));
      return out;
    }
    if (json.is_null()) return nullptr;
    if (json.is_string()) return json.text();
    if (json.is_boolean()) return json.truth();
    if (const auto* real = std::get_if<double>(&json.value_)) return *real;
    if (const auto* natural = std::get_if<std::uint64_t>(&json.value_)) return *natural;
    return json.whole();
  }

  static Json from_library(const Library& from) {
    if (from.is_object()) {
      Json out = Json::object();
      auto& [keys, values] = std::get<Json::Object>(out.value_);
      for (const auto& [key, value] : from.items()) {
        keys.push_back(key);
        values.push_back(from_library(value));
      }
      return out;
    }
    if (from.is_array()) {
      Json out = Json::array();
      for (const Library& value : from) out.push_back(from_library(value));
      return out;
    }
    if (from.is_string()) return from.get<std::string>();
    if (from.is_boolean()) return from.get<bool>();
    if (from.is_number_float()) return from.get<double>();
    if (from.is_number_unsigned()) return from.get<std::uint64_t>();
    if (from.is_number_integer()) return from.get<std::int64_t>();
    return nullptr;
  }
};

Json Json::parse(const std::string& text) {
  const auto found = JsonText::Library::parse(text, nullptr, false);
  if (found.is_discarded()) throw JsonError("a text is not JSON");
  return JsonText::from_library(found);
}

Json Json::parse_or_null(const std::string& text) {
  return JsonText::from_library(JsonText::Library::parse(text, nullptr, false));
}

std::string Json::dump(int indent) const {
  return JsonText::to_library(*this).dump(indent, ' ', false,
                                          JsonText::Library::error_handler_t::replace);
}

}  // namespace talus
