// libcore/import/point_table.hpp
// Points in a text file: a row a point, columns parted by commas, semicolons, tabs, bars or blanks,
// with or without a line of names.
// in:    the text of a CSV or XYZ file
// out:   x, y of each row, all other columns as they stand
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

struct PointTable {
  std::vector<std::string> names;  ///< of the columns that are no x and y
  std::vector<std::vector<std::string>>
      values;                   ///< of those columns, a row a point, without quotes
  std::vector<bool> is_number;  ///< whether all values of a column are numbers
  std::vector<Vec2> points;
  std::vector<int> line;       ///< of the file, from 1
  std::string x_from, y_from;  ///< names of the columns taken, "column 1" where none has a name
  bool is_degrees = false;     ///< they are called longitude and latitude
};

/// Columns are found by name (x and y, easting and northing, lon and lat ...); without names the
/// first three are x, y, z. Remarks begin with # or //. Decimal commas are read where no comma
/// parts columns. Throws InputError with the line for anything that is not a number where one must
/// be, for rows of different lengths, and where x and y cannot be told.
[[nodiscard]] PointTable parse_point_table(std::string text, const std::string& file);

/// Whether a column of the first line holds geometries as text (WKT), which are no table of points.
[[nodiscard]] bool has_wkt_column(const std::string& text);

/// A number with a decimal point, or with one decimal comma. False for anything else.
[[nodiscard]] bool parse_decimal(std::string word, double& value);

}  // namespace talus
