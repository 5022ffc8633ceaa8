// libcore/base/fields.hpp: public
// A result is a struct a row and one list of its fields. Layers, tables and their titles are made
// from the list; no other place names a field.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace talus {

/// monostate: none.
using FieldValue = std::variant<std::monostate, std::int64_t, double, std::string>;
enum class FieldType { integer, real, text, boolean };

template <class Row>
struct Field {
  const char* name;   ///< ends in its unit
  const char* unit;   ///< "": words, or a number without
  const char* title;  ///< in words
  FieldValue (*get)(const Row&);
  FieldType type = FieldType::real;
};

/// "Reach angle [deg]"
[[nodiscard]] std::string title_of(const char* title, const char* unit);

template <class Row>
[[nodiscard]] std::vector<FieldValue> values_of(const std::vector<Field<Row>>& fields,
                                                const Row& row) {
  std::vector<FieldValue> values;
  values.reserve(fields.size());
  for (const Field<Row>& field : fields) values.push_back(field.get(row));
  return values;
}

/// A line of a table (CSV), numbers with ten digits.
[[nodiscard]] std::string csv_row(const std::vector<FieldValue>& values);
template <class Row>
[[nodiscard]] std::vector<FieldValue> names_of(const std::vector<Field<Row>>& fields) {
  std::vector<FieldValue> names;
  for (const Field<Row>& field : fields) names.emplace_back(std::string(field.name));
  return names;
}

template <class Row>
[[nodiscard]] std::string csv_of(const std::vector<Field<Row>>& fields,
                                 const std::vector<Row>& rows) {
  std::string out = csv_row(names_of(fields));
  for (const Row& row : rows) out += csv_row(values_of(fields, row));
  return out;
}

}  // namespace talus
