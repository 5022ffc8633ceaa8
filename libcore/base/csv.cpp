// Parses comma-separated values: quotes, remarks, short rows.
#include "base/csv.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <string_view>

#include "base/column_text.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/printable.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

[[noreturn]] void throw_without_column(const CsvTable& table, const std::string& name) {
  std::string columns;
  for (const std::string& known : table.names) columns += (columns.empty() ? "" : ", ") + known;
  throw InputError({table.file}, "has no column " + name, "its columns are " + columns);
}

std::string trimmed(const std::string& word) {
  const std::size_t first = word.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return word.substr(first, word.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> split(const std::string& line, const Where& where) {
  std::vector<std::string> values(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
      values.back() += line[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      values.emplace_back();
    else
      values.back() += c;
  }
  if (quoted) throw InputError(where, "a quote is not closed", "end the value with \"");
  for (std::string& value : values) value = trimmed(value);
  return values;
}

}  // namespace

const std::string& CsvTable::at(std::size_t row, const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw_without_column(*this, name);
  return rows[row][found - names.begin()];
}

double CsvTable::number(std::size_t row, const std::string& name) const {
  const std::string& word = at(row, name);
  if (word.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  if (!parse_double(word, value))
    throw InputError({file, line[row]}, name + " is \"" + word + "\", expected a number");
  return value;
}

CsvTable parse_csv(const std::string& content, const std::string& file, bool fill_short_rows) {
  check_encoding(content, file);
  CsvTable table;
  table.file = file;
  constexpr std::string_view mark = "\xEF\xBB\xBF";  // that spreadsheet programs begin UTF-8 with
  std::istringstream stream(content.rfind(mark, 0) == 0 ? content.substr(mark.size()) : content);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> values = split(line, {file, number});
    if (table.names.empty()) {
      table.names = std::move(values);
      continue;
    }
    if (fill_short_rows && values.size() < table.names.size()) values.resize(table.names.size());
    if (values.size() != table.names.size())
      throw InputError({file, number}, "has " + std::to_string(values.size()) +
                                           " values, expected " +
                                           std::to_string(table.names.size()));
    table.rows.push_back(std::move(values));
    table.line.push_back(number);
  }
  if (table.rows.empty()) throw InputError({file}, "holds no row");
  return table;
}

CsvTable read_csv(const std::string& path) {
  const std::string content = read_file(path);
  require_memory_for_words(content, path);
  return parse_csv(content, path);
}

std::string csv_line(const std::vector<std::string>& values) {
  std::string line;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string value = printable(values[i]);
    if (i > 0) line += ',';
    if (value.find_first_of(",\"\n") == std::string::npos) {
      line += value;
      continue;
    }
    line += '"';
    for (const char c : value) line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line + "\n";
}

}  // namespace talus
