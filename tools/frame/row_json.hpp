// tools/frame/row_json.hpp
// A row of a result as a JSON object of its fields.
#pragma once

#include "base/fields.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

inline Json json_of(const FieldValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (const auto* words = std::get_if<std::string>(&value)) return *words;
  if (const auto* real = std::get_if<double>(&value)) return number_or_null(*real);
  return {};
}

template <class Row>
[[nodiscard]] Json row_json(const std::vector<Field<Row>>& fields, const Row& row) {
  Json out = Json::object();
  for (const Field<Row>& field : fields) out[field.name] = json_of(field.get(row));
  return out;
}

template <class Row>
[[nodiscard]] Json rows_json(const std::vector<Field<Row>>& fields, const std::vector<Row>& rows) {
  Json out = Json::array();
  for (const Row& row : rows) out.push_back(row_json(fields, row));
  return out;
}

}  // namespace talus
