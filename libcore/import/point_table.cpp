// Reads points from a text file, a row a point.
#include "import/point_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/thousands.hpp"

namespace talus {
namespace {

// Plain names of x and y that belong together.
struct NamePair {
  const char *x, *y;
};
constexpr NamePair names_of_metres[] = {{"x", "y"},
                                        {"easting", "northing"},
                                        {"east", "north"},
                                        {"e", "n"},
                                        {"xcoord", "ycoord"},
                                        {"coordx", "coordy"},
                                        {"pointx", "pointy"},
                                        {"posx", "posy"},
                                        {"utme", "utmn"},
                                        {"utmx", "utmy"},
                                        {"rechtswert", "hochwert"},
                                        {"rw", "hw"},
                                        {"ostwert", "nordwert"},
                                        {"ost", "nord"}};
constexpr NamePair names_of_degrees[] = {
    {"longitude", "latitude"}, {"lon", "lat"}, {"long", "lat"}, {"lng", "lat"}};

constexpr const char* with_a_point =
    "write all numbers with a point, and without signs between thousands";

// The column of that name, whatever its unit in brackets: x for "X [m]".
std::size_t column_named(const ColumnText& columns, const std::string& wanted) {
  const auto found =
      std::find_if(columns.names.begin(), columns.names.end(), [&wanted](const std::string& name) {
        return plain_name(name.substr(0, name.find_first_of("[("))) == wanted;
      });
  return static_cast<std::size_t>(found - columns.names.begin());
}

// Takes the columns of the one pair of names that is there.
bool find_pair(std::span<const NamePair> pairs, PointTable& table) {
  const ColumnText& columns = table.columns;
  const NamePair* taken = nullptr;
  for (const NamePair& pair : pairs) {
    const std::size_t x = column_named(columns, pair.x), y = column_named(columns, pair.y);
    if (std::max(x, y) == columns.names.size()) continue;
    if (taken != nullptr)
      throw InputError({columns.file},
                       std::string("has columns ") + taken->x + " and " + taken->y + ", and " +
                           pair.x + " and " + pair.y + ", expected one pair of coordinates",
                       "give the columns that are not meant another name");
    taken = &pair;
    table.x = x, table.y = y;
  }
  return taken != nullptr;
}

// Why the first of at least four columns without names may number the points, as lists of surveys
// do (number, northing, easting, height, code): it counts 1, 2, 3, is whole where those behind it
// are not, holds each whole number once, or the fifth holds words. Empty: it may not.
std::string why_numbered(const ColumnText& columns) {
  bool counts_up = true, is_whole = true, has_code = false;
  std::array<bool, 2> has_decimals = {};  // columns 2 and 3
  std::set<double> whole;
  double last = 0, value = 0;
  for (const std::vector<std::string>& words : columns.rows) {
    if (words.size() < 4 || !parse_number(columns, words[0], value)) return "";
    counts_up = counts_up && (&words == &columns.rows.front() || value == last + 1);
    is_whole = is_whole && words[0].find_first_not_of("0123456789") == std::string::npos;
    if (value == std::floor(value)) whole.insert(value);
    for (std::size_t c = 0; c < 2; ++c)
      has_decimals[c] = has_decimals[c] || words[c + 1].find_first_of(".,") != std::string::npos;
    has_code = has_code ||
               (words.size() > 4 && !words[4].empty() && !parse_number(columns, words[4], value));
    last = value;
  }
  if (counts_up && is_whole && (columns.rows.size() > 1 || last == 1)) return "counts the rows";
  if (is_whole && has_decimals[0] && has_decimals[1])
    return "holds whole numbers alone, as a point number does";
  if (columns.rows.size() > 2 && whole.size() == columns.rows.size())
    return "holds whole numbers, each of them once, as a point number does";
  return has_code ? "may number the points: the fifth holds words" : "";
}

void name_columns(PointTable& table) {
  ColumnText& columns = table.columns;
  if (find_pair(names_of_metres, table)) return;
  table.is_degrees = find_pair(names_of_degrees, table);
  if (table.is_degrees) return;
  const std::size_t n_columns = columns.rows.front().size();
  const Where where{columns.file, columns.line.front()};
  if ((!columns.names.empty() && !columns.names_in_remark) || n_columns < 2)
    throw InputError(where,
                     (columns.names.empty() ? counted(1, "column") + " without a name"
                                            : "the columns are " + list_of_names(columns)) +
                         ", expected columns named x and y (or easting and northing, lon and "
                         "lat), or numbers",
                     "name the columns in a first line, for example x,y,z");
  if (const std::string why = why_numbered(columns); !why.empty())
    throw InputError(where,
                     "the first of " + std::to_string(n_columns) + " columns without names " + why +
                         ", expected x, y, z",
                     "name the columns in a first line, for example number,northing,easting,z");
  columns.names.clear();
  for (std::size_t c = 0; c < n_columns; ++c)
    columns.names.push_back(c == 2 ? "z" : (c < 2 ? "column " : "column_") + std::to_string(c + 1));
}

// Reads the coordinates, and finds out which of the other columns hold numbers.
void read_numbers(PointTable& table) {
  const ColumnText& columns = table.columns;
  const std::size_t n_columns = columns.names.size();
  table.is_number.assign(n_columns, true);
  std::vector<ThousandsDoubt> thousands(n_columns);
  for (std::size_t row = 0; row < columns.rows.size(); ++row) {
    const std::vector<std::string>& words = columns.rows[row];
    const Where where{columns.file, columns.line[row]};
    if (words.size() != n_columns)
      throw InputError(where,
                       "has " + counted(static_cast<std::int64_t>(words.size()), "column") +
                           ", expected " + std::to_string(n_columns) + " as above",
                       "mend the line, or take it out");
    Vec2& point = table.points.emplace_back();
    for (std::size_t c = 0; c < n_columns; ++c) {
      double value = 0;
      const bool is_number = parse_number(columns, words[c], value);
      if (c == table.x || c == table.y) {
        if (!is_number)
          throw InputError(where, "says \"" + words[c] + "\", expected a number",
                           words[c].find_first_of("0123456789") < 2
                               ? with_a_point
                               : "mend the line, or take it out");
        (c == table.x ? point.x() : point.y()) = value;
        continue;
      }
      table.is_number[c] = table.is_number[c] && (is_number || words[c].empty());
      thousands[c].add(words[c]);
    }
  }
  // stays as text, so that a reader of heights asks for its meaning
  for (std::size_t c = 0; c < n_columns; ++c)
    if (thousands[c].is_doubtful()) table.is_number[c] = false;
}

// Decimal points and decimal commas are not mixed in one file: one of them parts thousands.
void check_decimals(const PointTable& table) {
  bool has_comma = false, has_point = false;
  for (std::size_t row = 0; row < table.columns.rows.size(); ++row)
    for (std::size_t c = 0; c < table.is_number.size(); ++c) {
      const std::string& word = table.columns.rows[row][c];
      if (!table.is_number[c]) continue;
      has_comma = has_comma || word.find(',') != std::string::npos;
      has_point = has_point || word.find('.') != std::string::npos;
      if (has_comma && has_point)
        throw InputError(
            {table.columns.file, table.columns.line[row]},
            "the file has numbers with a decimal comma and with a point, last \"" + word + "\"",
            with_a_point);
    }
}

}  // namespace

bool has_wkt_column(const std::string& text) {
  const std::string head = text.substr(0, text.find_first_of("\r\n"));
  for (std::size_t begin = 0, end = 0; begin <= head.size(); begin = end + 1) {
    end = std::min(head.find_first_of(",;\t|", begin), head.size());
    const std::string name = plain_name(head.substr(begin, end - begin));
    if (name == "geom" || name == "geometry" || name == "thegeom" || name.ends_with("wkt"))
      return true;
  }
  return false;
}

PointTable parse_point_table(const std::string& text, const std::string& file) {
  PointTable table;
  table.columns = parse_columns(text, file);
  std::vector<std::vector<std::string>>& rows = table.columns.rows;
  if (lower(file).ends_with(".pts") && rows.size() > 1 && rows.front().size() == 1) {
    rows.erase(rows.begin());  // the number of points
    table.columns.line.erase(table.columns.line.begin());
  }
  name_columns(table);
  read_numbers(table);
  check_decimals(table);
  return table;
}

}  // namespace talus
