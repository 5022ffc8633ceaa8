// libcore/import/point_table.hpp
// Points in a text file, a row a point, with or without a line of names.
// in:    the text of a CSV or XYZ file
// out:   x, y of each row, all columns as text
#pragma once

#include <string>
#include <vector>

#include "base/column_text.hpp"
#include "base/types.hpp"

namespace talus {

struct PointTable {
  ColumnText columns;           ///< rows of one length; without names "column 1", ... z, column_4
  std::size_t x = 0, y = 1;     ///< columns of the coordinates
  bool is_degrees = false;      ///< they are called longitude and latitude
  std::vector<bool> is_number;  ///< whether all values of a column are numbers, or empty
  std::vector<Vec2> points;     ///< of each row
};

/// Columns are found by name (x and y, easting and northing, lon and lat ...); without names the
/// first three are x, y, z. Throws InputError with the line for anything that is not a number where
/// one must be, for rows of different lengths, for decimal points and commas in one file, and where
/// x and y cannot be told.
[[nodiscard]] PointTable parse_point_table(const std::string& text, const std::string& file);

/// Whether a column of the first line holds geometries as text (WKT), which are not a table of
/// points.
[[nodiscard]] bool has_wkt_column(const std::string& text);

}  // namespace talus
