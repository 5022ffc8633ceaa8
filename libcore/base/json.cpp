// Building, comparing and looking up JSON values; their text is in json_text_json.cpp.
#include "base/json.hpp"

#include <algorithm>

namespace talus {
namespace {

[[noreturn]] void refuse(const char* wanted) {
  throw JsonError(std::string("a value of JSON is not ") + wanted);
}

template <class T, class Value>
const T& held(const Value& value, const char* wanted) {
  if (const T* found = std::get_if<T>(&value)) return *found;
  refuse(wanted);
}

}  // namespace

Json::Json() = default;
Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json::Json(std::nullptr_t) {}
Json::Json(Truth truth) : value_(truth.value) {}
Json::Json(Real real) : value_(real.value) {}
Json::Json(Whole whole) : value_(whole.value) {}
Json::Json(Natural natural) : value_(natural.value) {}
Json::Json(const char* text) : value_(std::string(text)) {}
Json::Json(std::string text) : value_(std::move(text)) {}

Json::Json(std::initializer_list<Json> values) {
  const bool is_object = std::all_of(values.begin(), values.end(), [](const Json& pair) {
    return pair.is_array() && pair.size() == 2 && pair.front().is_string();
  });
  if (!is_object) {
    value_ = Array(values);
    return;
  }
  Object& object = value_.emplace<Object>();
  for (const Json& pair : values) {
    object.keys.push_back(pair.front().text());
    object.values.push_back(pair.back());
  }
}

Json Json::array(std::initializer_list<Json> values) {
  Json json;
  json.value_ = Array(values);
  return json;
}

Json Json::object() {
  Json json;
  json.value_ = Object();
  return json;
}

bool Json::is_null() const { return std::holds_alternative<std::monostate>(value_); }
bool Json::is_boolean() const { return std::holds_alternative<bool>(value_); }
bool Json::is_number() const {
  return std::holds_alternative<double>(value_) || is_number_integer();
}
bool Json::is_number_integer() const {
  return std::holds_alternative<std::int64_t>(value_) ||
         std::holds_alternative<std::uint64_t>(value_);
}
bool Json::is_string() const { return std::holds_alternative<std::string>(value_); }
bool Json::is_array() const { return std::holds_alternative<Array>(value_); }
bool Json::is_object() const { return std::holds_alternative<Object>(value_); }

bool Json::truth() const { return held<bool>(value_, "true or false"); }
const std::string& Json::text() const { return held<std::string>(value_, "a text"); }

double Json::real() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*whole);
  if (const auto* natural = std::get_if<std::uint64_t>(&value_))
    return static_cast<double>(*natural);
  return held<double>(value_, "a number");
}

std::int64_t Json::whole() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return *whole;
  if (const auto* natural = std::get_if<std::uint64_t>(&value_))
    return static_cast<std::int64_t>(*natural);
  return static_cast<std::int64_t>(held<double>(value_, "a number"));
}

const Json::Array& Json::values() const {
  static const Array none;
  if (is_null()) return none;
  if (const Object* object = std::get_if<Object>(&value_)) return object->values;
  return held<Array>(value_, "an array or an object");
}

Json::Array& Json::own_values() { return const_cast<Array&>(values()); }

std::size_t Json::size() const {
  return is_null() || is_array() || is_object() ? values().size() : 1;
}

bool Json::empty() const { return size() == 0; }

bool Json::contains(const std::string& key) const {
  const Object* object = std::get_if<Object>(&value_);
  return object && std::find(object->keys.begin(), object->keys.end(), key) != object->keys.end();
}

Json& Json::operator[](const std::string& key) {
  if (is_null()) value_ = Object();
  if (!is_object()) refuse("an object");
  Object& object = std::get<Object>(value_);
  const auto at = std::find(object.keys.begin(), object.keys.end(), key);
  if (at != object.keys.end())
    return object.values[static_cast<std::size_t>(at - object.keys.begin())];
  object.keys.push_back(key);
  return object.values.emplace_back();
}

const Json& Json::at(const std::string& key) const {
  const Object& object = held<Object>(value_, "an object");
  const auto at = std::find(object.keys.begin(), object.keys.end(), key);
  if (at == object.keys.end()) throw JsonError("an object of JSON has no member " + key);
  return object.values[static_cast<std::size_t>(at - object.keys.begin())];
}

const Json& Json::item_at(std::size_t index) const {
  const Array& array = held<Array>(value_, "an array");
  if (index >= array.size())
    throw JsonError("an array of JSON has no value " + std::to_string(index));
  return array[index];
}

Json& Json::item(std::size_t index) {
  if (is_null()) value_ = Array();
  if (!is_array()) refuse("an array");
  Array& array = std::get<Array>(value_);
  if (index >= array.size()) array.resize(index + 1);
  return array[index];
}

void Json::push_back(Json value) { item(size()) = std::move(value); }

Json& Json::back() { return const_cast<Json&>(std::as_const(*this).back()); }

void Json::update(const Json& object) {
  for (const auto& [key, value] : object.items()) (*this)[key] = value;
}

std::vector<std::pair<std::string, Json>> Json::items() const {
  std::vector<std::pair<std::string, Json>> out;
  if (is_null()) return out;
  const Object& object = held<Object>(value_, "an object");
  for (std::size_t i = 0; i < object.keys.size(); ++i)
    out.emplace_back(object.keys[i], object.values[i]);
  return out;
}

bool operator==(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number())
    return a.is_number_integer() && b.is_number_integer() ? a.whole() == b.whole()
                                                          : a.real() == b.real();
  if (a.value_.index() != b.value_.index()) return false;
  if (a.is_object()) {
    const auto& [keys, values] = std::get<Json::Object>(a.value_);
    const auto& [other_keys, other_values] = std::get<Json::Object>(b.value_);
    return keys == other_keys && values == other_values;
  }
  if (a.is_array()) return a.values() == b.values();
  if (a.is_string()) return a.text() == b.text();
  return !a.is_boolean() || a.truth() == b.truth();
}

}  // namespace talus
