#include "import/point_table.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "base/error.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "base/thousands.hpp"

namespace talus {
namespace {

using Words = std::vector<std::string>;

struct Line {
  std::string text;
  int number = 0;
};

// Names of x and y that belong together, in lower case.
struct NamePair {
  const char* x;
  const char* y;
  bool is_degrees = false;
};
constexpr std::array name_pairs = {NamePair{"x", "y"},
                                   NamePair{"easting", "northing"},
                                   NamePair{"east", "north"},
                                   NamePair{"e", "n"},
                                   NamePair{"x_coord", "y_coord"},
                                   NamePair{"xcoord", "ycoord"},
                                   NamePair{"coord_x", "coord_y"},
                                   NamePair{"point_x", "point_y"},
                                   NamePair{"pos_x", "pos_y"},
                                   NamePair{"utm_e", "utm_n"},
                                   NamePair{"utm_x", "utm_y"},
                                   NamePair{"rechtswert", "hochwert"},
                                   NamePair{"rw", "hw"},
                                   NamePair{"ostwert", "nordwert"},
                                   NamePair{"ost", "nord"},
                                   NamePair{"longitude", "latitude", true},
                                   NamePair{"lon", "lat", true},
                                   NamePair{"long", "lat", true},
                                   NamePair{"lng", "lat", true}};

std::string trimmed(const std::string& word) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  std::size_t begin = 0, end = word.size();
  while (begin < end && is_blank(word[begin])) ++begin;
  while (end > begin && is_blank(word[end - 1])) --end;
  return word.substr(begin, end - begin);
}

// In lower case, without a unit in brackets: "x" for "X [m]".
std::string plain_name(const std::string& name) {
  return lower(trimmed(name.substr(0, name.find_first_of("[("))));
}

// Blanks part columns as often as they like; other signs leave empty words, and quotes keep them.
Words parted(const std::string& line, char separator) {
  Words words;
  std::string word;
  bool is_quoted = false;
  const auto end_word = [&] {
    if (separator != ' ' || !word.empty()) words.push_back(trimmed(word));
    word.clear();
  };
  for (const char c : line) {
    if (c == '"')
      is_quoted = !is_quoted;
    else if (!is_quoted && (c == separator || (separator == ' ' && c == '\t')))
      end_word();
    else
      word += c;
  }
  end_word();
  return words;
}

bool begins_remark(const std::string& line) {
  return line.rfind('#', 0) == 0 || line.rfind("//", 0) == 0;
}

std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find_first_of("\r\n", begin);
    if (end == std::string::npos) end = text.size();
    ++number;
    const std::string line = trimmed(text.substr(begin, end - begin));
    if (!line.empty()) lines.push_back({line, number});
    const bool is_pair = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
    begin = end + (is_pair ? 2 : 1);
  }
  return lines;
}

bool is_number(const std::string& word) {
  double value = 0;
  return parse_decimal(word, value);
}

// How the columns are parted and called. `names` is empty where no line names them.
struct Layout {
  char separator = ',';
  Words names;
  std::size_t x = 0, y = 1;
  bool is_degrees = false;
  std::size_t first_row = 0;  // among the lines
};

// The columns of the one pair of names that is there; metres go before degrees.
bool find_columns(const Words& names, const std::string& file, Layout& layout) {
  const auto column = [&names](const char* name) {
    const auto found = std::find_if(names.begin(), names.end(), [name](const std::string& other) {
      return plain_name(other) == name;
    });
    return static_cast<std::size_t>(found - names.begin());
  };
  const NamePair* taken = nullptr;
  for (const NamePair& pair : name_pairs) {
    if (column(pair.x) == names.size() || column(pair.y) == names.size()) continue;
    if (taken != nullptr && pair.is_degrees) continue;
    if (taken != nullptr)
      throw InputError({file},
                       std::string("has columns ") + taken->x + " and " + taken->y + ", and " +
                           pair.x + " and " + pair.y + ", expected one pair of coordinates",
                       "give the columns that are not meant another name");
    taken = &pair;
  }
  if (taken == nullptr) return false;
  layout.names = names;
  layout.x = column(taken->x);
  layout.y = column(taken->y);
  layout.is_degrees = taken->is_degrees;
  return true;
}

// Why the first of at least four columns without names may number the points, as lists of surveys
// do (number, northing, easting, height, code): it counts 1, 2, 3, is whole where those behind it
// are not, or the fifth holds words. Empty: it may not.
std::string why_numbered(const std::vector<Line>& lines, char separator) {
  bool counts_up = true, is_whole = true, has_code = false;
  std::array<bool, 2> has_decimals = {};  // columns 2 and 3
  std::int64_t n_rows = 0;
  double last = 0;
  for (const Line& line : lines) {
    if (begins_remark(line.text)) continue;
    const Words words = parted(line.text, separator);
    double value = 0;
    if (words.size() < 4 || !parse_decimal(words[0], value)) return "";
    counts_up = counts_up && (n_rows > 0 ? value == last + 1 : true);
    is_whole = is_whole && words[0].find_first_not_of("0123456789") == std::string::npos;
    for (std::size_t c = 0; c < 2; ++c)
      has_decimals[c] = has_decimals[c] || words[c + 1].find_first_of(".,") != std::string::npos;
    has_code = has_code || (words.size() > 4 && !words[4].empty() && !is_number(words[4]));
    last = value;
    ++n_rows;
  }
  if (counts_up && is_whole && (n_rows > 1 || last == 1)) return "counts the rows";
  if (is_whole && has_decimals[0] && has_decimals[1])
    return "holds whole numbers alone, as a point number does";
  return has_code ? "may number the points: the fifth holds words" : "";
}

std::optional<Layout> layout_with(char separator, const std::vector<Line>& lines,
                                  const std::string& file) {
  Layout layout;
  layout.separator = separator;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string line = lines[i].text;
    const bool is_remark = begins_remark(line);
    if (is_remark) line.erase(0, line.find_first_not_of("#/ \t"));
    const Words words = parted(line, separator);
    layout.first_row = i + 1;
    if (words.size() >= 2 && find_columns(words, file, layout)) return layout;
    if (is_remark) continue;
    layout.first_row = i;
    if (words.size() < 2 || !is_number(words[0]) || !is_number(words[1])) return std::nullopt;
    if (const std::string why = why_numbered(lines, separator); !why.empty())
      throw InputError({file, lines[i].number},
                       "the first of " + std::to_string(words.size()) + " columns without names " +
                           why + ", expected x, y, z",
                       "name the columns in a first line, for example number,northing,easting,z");
    return layout;
  }
  return std::nullopt;
}

Layout find_layout(const std::vector<Line>& lines, const std::string& file) {
  for (const char separator : {';', '\t', '|', ',', ' '})
    if (const std::optional<Layout> layout = layout_with(separator, lines, file)) return *layout;
  const std::string first = lines.empty() ? "" : lines.front().text.substr(0, 60);
  throw InputError({file, lines.empty() ? 0 : lines.front().number},
                   lines.empty() ? "holds no row"
                                 : "begins with \"" + first +
                                       "\", expected columns named x and y (or easting and "
                                       "northing, lon and lat), or numbers",
                   "name the columns in a first line, for example x,y,z");
}

// Decimal points and decimal commas are not mixed in one file: one of them parts thousands.
class Decimals {
 public:
  double number(const std::string& word, const Where& where) {
    double value = 0;
    if (!parse_decimal(word, value))
      throw InputError(
          where, "says \"" + word + "\", expected a number",
          word.find_first_of("0123456789") < 2 ? with_a_point : "mend the line, or take it out");
    has_comma_ = has_comma_ || word.find(',') != std::string::npos;
    has_point_ = has_point_ || word.find('.') != std::string::npos;
    if (has_comma_ && has_point_)
      throw InputError(
          where,
          "the file has numbers with a decimal comma and with a point, last \"" + word + "\"",
          with_a_point);
    return value;
  }

 private:
  static constexpr const char* with_a_point =
      "write all numbers with a point, and without signs between thousands";
  bool has_comma_ = false, has_point_ = false;
};

void name_columns(const Layout& layout, std::size_t n_columns, PointTable& table) {
  for (std::size_t c = 0; c < n_columns; ++c) {
    const std::string counted_name = c == 2 ? "z" : "column_" + std::to_string(c + 1);
    const std::string name = layout.names.empty() ? counted_name : layout.names[c];
    if (c == layout.x)
      table.x_from = layout.names.empty() ? "column 1" : name;
    else if (c == layout.y)
      table.y_from = layout.names.empty() ? "column 2" : name;
    else
      table.names.push_back(name);
  }
  table.is_number.assign(table.names.size(), true);
}

void add_row(const Layout& layout, const Words& words, const Where& where, Decimals& decimals,
             PointTable& table) {
  table.points.emplace_back(decimals.number(words[layout.x], where),
                            decimals.number(words[layout.y], where));
  table.line.push_back(where.line);
  Words& others = table.values.emplace_back();
  for (std::size_t c = 0; c < words.size(); ++c) {
    if (c == layout.x || c == layout.y) continue;
    const std::size_t k = others.size();
    table.is_number[k] = table.is_number[k] && (words[c].empty() || is_number(words[c]));
    others.push_back(words[c]);
  }
}

// Values of a column of numbers are held to the same sign of decimals as x and y, and written with
// a point.
void write_with_points(Decimals& decimals, const std::string& file, PointTable& table) {
  for (std::size_t row = 0; row < table.values.size(); ++row)
    for (std::size_t k = 0; k < table.names.size(); ++k) {
      std::string& word = table.values[row][k];
      if (!table.is_number[k] || word.empty()) continue;
      static_cast<void>(decimals.number(word, {file, table.line[row]}));
      std::replace(word.begin(), word.end(), ',', '.');
    }
}

void drop_mark(const std::string& file, std::string& text) {
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
  if (text.rfind("\xFF\xFE", 0) == 0 || text.rfind("\xFE\xFF", 0) == 0)
    throw InputError({file}, "is written in UTF-16, expected UTF-8",
                     "iconv -f UTF-16 -t UTF-8 " + command_words(file) + " > points.csv");
}

}  // namespace

bool parse_decimal(std::string word, double& value) {
  const std::size_t comma = word.find(',');
  if (comma != std::string::npos) {
    if (word.find_first_of(",.", comma + 1) != std::string::npos || word.find('.') < comma)
      return false;
    word[comma] = '.';
  }
  return parse_double(!word.empty() && word[0] == '+' ? word.substr(1) : word, value);
}

bool has_wkt_column(const std::string& text) {
  const std::string head = lower(text.substr(0, text.find_first_of("\r\n")));
  const auto holds_geometry = [](const std::string& word) {
    const std::string name = plain_name(word);
    return name == "wkt" || name == "geom" || name == "geometry" || name == "the_geom" ||
           name.ends_with("_wkt");
  };
  for (const char separator : {',', ';', '\t', '|'}) {
    const Words words = parted(head, separator);
    if (std::any_of(words.begin(), words.end(), holds_geometry)) return true;
  }
  return false;
}

PointTable parse_point_table(std::string text, const std::string& file) {
  drop_mark(file, text);
  std::vector<Line> lines = lines_of(text);
  if (lower(file).ends_with(".pts") && !lines.empty() &&
      lines.front().text.find_first_not_of("0123456789") == std::string::npos)
    lines.erase(lines.begin());  // the number of points
  const Layout layout = find_layout(lines, file);
  PointTable table;
  table.is_degrees = layout.is_degrees;
  Decimals decimals;
  std::size_t n_columns = layout.names.size();
  std::vector<ThousandsDoubt> thousands;
  for (std::size_t i = layout.first_row; i < lines.size(); ++i) {
    if (begins_remark(lines[i].text)) continue;
    const Words words = parted(lines[i].text, layout.separator);
    if (n_columns == 0) n_columns = words.size();
    if (table.points.empty()) name_columns(layout, n_columns, table);
    const Where where{file, lines[i].number};
    if (words.size() != n_columns)
      throw InputError(where,
                       "has " + counted(static_cast<std::int64_t>(words.size()), "column") +
                           ", expected " + std::to_string(n_columns) + " as above",
                       "mend the line, or take it out");
    add_row(layout, words, where, decimals, table);
    thousands.resize(table.names.size());
    for (std::size_t k = 0; k < thousands.size(); ++k) thousands[k].add(table.values.back()[k]);
  }
  // stays as text, so that who takes it for heights asks what it means
  for (std::size_t k = 0; k < thousands.size(); ++k)
    if (thousands[k].is_doubtful()) table.is_number[k] = false;
  if (table.points.empty()) throw InputError({file}, "holds no row, expected points");
  write_with_points(decimals, file, table);
  return table;
}

}  // namespace talus
