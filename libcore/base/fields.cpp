// Text of result fields: titles with their units, and rows of CSV tables.
#include "base/fields.hpp"

#include <cmath>

#include "base/csv.hpp"
#include "base/text.hpp"

namespace talus {

std::string title_of(const char* title, const char* unit) {
  return *unit == '\0' ? std::string(title) : std::string(title) + " [" + unit + "]";
}

std::string csv_row(const std::vector<FieldValue>& values) {
  std::vector<std::string> cells;
  for (const FieldValue& value : values) {
    if (const auto* whole = std::get_if<std::int64_t>(&value))
      cells.push_back(std::to_string(*whole));
    else if (const auto* words = std::get_if<std::string>(&value))
      cells.push_back(*words);
    else if (const auto* real = std::get_if<double>(&value); real != nullptr && !std::isnan(*real))
      cells.push_back(text(*real, 10));
    else
      cells.emplace_back();
  }
  return csv_line(cells);
}

}  // namespace talus
