// libcore/base/csv.hpp: public
// Small data files of ours: comma-separated values with a line of names, '#' lines are remarks.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace talus {

struct CsvTable {
  std::string file;  ///< path as messages name it
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;  ///< as long as `names`
  std::vector<int> line;                       ///< of each row, from 1

  /// Throws InputError when the column is missing.
  [[nodiscard]] const std::string& at(std::size_t row, const std::string& name) const;
  /// The number in a column, NaN when it is empty. Throws InputError with the line for other text.
  [[nodiscard]] double number(std::size_t row, const std::string& name) const;
};

/// Values with a comma are in double quotes; a double quote in them is doubled; blanks around a
/// value are not part of it. Throws InputError with the line for a row of another length, an open
/// quote, or a table without a row; with `fill_short_rows` a row that ends early has empty values.
[[nodiscard]] CsvTable parse_csv(const std::string& text, const std::string& file,
                                 bool fill_short_rows = false);
/// Throws InputError when the file cannot be read, or as parse_csv().
[[nodiscard]] CsvTable read_csv(const std::string& path);

/// One line of values, printable() and quoted where they must be, with a line feed.
[[nodiscard]] std::string csv_line(const std::vector<std::string>& values);

}  // namespace talus
