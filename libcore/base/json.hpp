// libcore/base/json.hpp: public
// A JSON value, as tools write their results and read those of other programs. Members of an object
// keep their order. The library that reads and writes the text is compiled in json_text_json.cpp
// alone.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace talus {

/// A text is not JSON, or a value has another type than requested.
class JsonError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class T>
concept JsonInteger = std::integral<T> && !std::same_as<T, bool>;

class Json {
 public:
  Json();  ///< null
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();
  Json(std::nullptr_t);
  Json(std::same_as<bool> auto truth) : Json(Truth{truth}) {}
  Json(std::floating_point auto real) : Json(Real{real}) {}
  Json(std::signed_integral auto whole) : Json(Whole{whole}) {}
  template <std::unsigned_integral T>
  requires JsonInteger<T> Json(T natural) : Json(Natural{natural}) {}
  Json(const char* text);
  Json(std::string text);
  template <class T>
  Json(const std::vector<T>& list) : Json(array()) {
    for (const T& value : list) push_back(value);
  }
  template <class T, std::size_t n>
  Json(const std::array<T, n>& list) : Json(array()) {
    for (const T& value : list) push_back(value);
  }
  /// An object where each value is a pair that begins with a text, else an array.
  Json(std::initializer_list<Json> values);
  [[nodiscard]] static Json array(std::initializer_list<Json> values = {});
  [[nodiscard]] static Json object();

  /// Throws JsonError.
  [[nodiscard]] static Json parse(const std::string& text);
  /// null for text that is not JSON.
  [[nodiscard]] static Json parse_or_null(const std::string& text);
  /// As one line, or with `indent` blanks a level; bytes that are not UTF-8 are replaced.
  [[nodiscard]] std::string dump(int indent = -1) const;

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] bool is_boolean() const;
  [[nodiscard]] bool is_number() const;
  [[nodiscard]] bool is_number_integer() const;
  [[nodiscard]] bool is_string() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_object() const;

  /// Throws JsonError where the value is of another kind. A number is cut to a whole one.
  template <class T>
  [[nodiscard]] T get() const {
    if constexpr (std::same_as<T, bool>) {
      return truth();
    } else if constexpr (std::same_as<T, std::string>) {
      return text();
    } else if constexpr (std::integral<T>) {
      return static_cast<T>(whole());
    } else if constexpr (std::floating_point<T>) {
      return static_cast<T>(real());
    } else {
      T list;
      for (const Json& value : values()) list.push_back(value.get<typename T::value_type>());
      return list;
    }
  }
  template <class T>
  void get_to(T& value) const {
    value = get<T>();
  }

  // --- arrays and objects; null becomes one when something is put into it ------------------------
  [[nodiscard]] std::size_t size() const;  ///< 0: null; 1: a single value
  [[nodiscard]] bool empty() const;
  [[nodiscard]] bool contains(const std::string& key) const;
  Json& operator[](const std::string& key);
  Json& operator[](const char* key) { return (*this)[std::string(key)]; }
  Json& operator[](JsonInteger auto index) { return item(static_cast<std::size_t>(index)); }
  const Json& operator[](const std::string& key) const { return at(key); }
  const Json& operator[](const char* key) const { return at(key); }
  const Json& operator[](JsonInteger auto index) const { return at(index); }
  /// Throws JsonError where there is none.
  [[nodiscard]] const Json& at(const std::string& key) const;
  [[nodiscard]] const Json& at(const char* key) const { return at(std::string(key)); }
  [[nodiscard]] const Json& at(JsonInteger auto index) const {
    return item_at(static_cast<std::size_t>(index));
  }
  /// `otherwise` where the member is missing.
  template <class T>
  [[nodiscard]] T value(const std::string& key, const T& otherwise) const {
    if (!contains(key)) return otherwise;
    if constexpr (std::same_as<T, Json>)
      return at(key);
    else
      return at(key).template get<T>();
  }
  [[nodiscard]] std::string value(const std::string& key, const char* otherwise) const {
    return value(key, std::string(otherwise));
  }
  void push_back(Json value);
  void emplace_back(Json value) { push_back(std::move(value)); }
  void update(const Json& object);  ///< sets its members
  [[nodiscard]] Json& back();
  [[nodiscard]] const Json& front() const { return item_at(0); }
  [[nodiscard]] const Json& back() const { return item_at(size() - 1); }
  /// The values of an array or an object.
  [[nodiscard]] auto begin() const { return values().begin(); }
  [[nodiscard]] auto end() const { return values().end(); }
  [[nodiscard]] auto begin() { return own_values().begin(); }
  [[nodiscard]] auto end() { return own_values().end(); }
  /// Members of an object with their names.
  [[nodiscard]] std::vector<std::pair<std::string, Json>> items() const;

  friend bool operator==(const Json& a, const Json& b);  ///< numbers by their value

 private:
  struct Truth {
    bool value;
  };
  struct Real {
    double value;
  };
  struct Whole {
    std::int64_t value;
  };
  struct Natural {
    std::uint64_t value;
  };
  struct Object {
    std::vector<std::string> keys;
    std::vector<Json> values;
  };
  using Array = std::vector<Json>;
  friend struct JsonText;

  explicit Json(Truth truth);
  explicit Json(Real real);
  explicit Json(Whole whole);
  explicit Json(Natural natural);
  [[nodiscard]] bool truth() const;
  [[nodiscard]] double real() const;
  [[nodiscard]] std::int64_t whole() const;
  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] const Array& values() const;
  [[nodiscard]] Array& own_values();
  [[nodiscard]] const Json& item_at(std::size_t index) const;
  Json& item(std::size_t index);

  std::variant<std::monostate, bool, double, std::int64_t, std::uint64_t, std::string, Array,
               Object>
      value_;
};

/// null for NaN and infinity, which JSON does not have.
[[nodiscard]] inline Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

}  // namespace talus
