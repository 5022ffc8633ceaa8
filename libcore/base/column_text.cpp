// Parses text files of columns: delimiter, line of names, remarks, quoted words.
#include "base/column_text.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view words) {
  const std::size_t begin = words.find_first_not_of(blanks);
  if (begin == words.npos) return {};
  return words.substr(begin, words.find_last_not_of(blanks) - begin + 1);
}

// Length of the mark that makes a line a remark; 0: it is none.
std::size_t remark_mark(std::string_view line) {
  if (line.starts_with("//")) return 2;
  return !line.empty() && std::string_view("#*!%").find(line.front()) != line.npos ? 1 : 0;
}

// Words between delimiters; in double quotes a delimiter is part of the word.
std::vector<std::string> split(std::string_view line, char delimiter) {
  std::vector<std::string> words;
  std::string word;
  bool is_quoted = false, was_quoted = false;
  const auto end_word = [&] {
    const bool keeps_empty = delimiter != ' ' || was_quoted;
    const std::string_view text = was_quoted ? std::string_view(word) : trimmed(word);
    if (keeps_empty || !text.empty()) words.emplace_back(text);
    word.clear();
    was_quoted = false;
  };
  for (const char c : line) {
    const bool ends_word = !is_quoted && (c == delimiter || (delimiter == ' ' && c == '\t'));
    if (c == '"' && (is_quoted || trimmed(word).empty())) {
      is_quoted = !is_quoted;
      if (is_quoted) word.clear();
      was_quoted = true;
    } else if (ends_word) {
      end_word();
    } else {
      word += c;
    }
  }
  end_word();
  return words;
}

// 180,7 between blanks: a decimal comma, as in 180,7 21,6.
bool is_decimal_comma(std::string_view line, std::size_t at) {
  const auto is_digit = [&](std::size_t i) {
    return i < line.size() && std::isdigit(static_cast<unsigned char>(line[i])) != 0;
  };
  return at > 0 && is_digit(at - 1) && is_digit(at + 1);
}

bool has_decimal_commas(std::string_view line) {
  const std::vector<std::string> words = split(line, ' ');
  return words.size() > 1 && std::all_of(words.begin(), words.end(), [](const std::string& word) {
           const std::size_t at = word.find(',');
           return at == word.npos || (at == word.rfind(',') && is_decimal_comma(word, at));
         });
}

char delimiter_of(std::string_view line) {
  for (const char c : {';', '\t', '|'})
    if (line.find(c) != line.npos) return c;
  return line.find(',') == line.npos || has_decimal_commas(line) ? ' ' : ',';
}

// Whether a word may be a value: a number, 045/60, N45E; a name begins with a letter that is none
// of a compass.
bool has_digit_first(std::string_view word) {
  const std::size_t at = word.find_first_not_of("+-.,");
  if (at == word.npos) return false;
  if (std::isdigit(static_cast<unsigned char>(word[at])) != 0) return true;
  const bool is_compass = word.size() > 2 && std::string_view("NSns").find(word[0]) != word.npos;
  const std::size_t turn = word.find_first_not_of("0123456789.", 1);
  return is_compass && turn > 1 && turn != word.npos &&
         std::string_view("EWew").find(word[turn]) != word.npos;
}

bool holds_value(std::string_view line) {
  const std::vector<std::string> words = split(line, delimiter_of(line));
  return std::any_of(words.begin(), words.end(), has_digit_first);
}

std::string_view without_mark(const std::string& text) {
  std::string_view rest(text);
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  return rest;
}

// The next line, with the end that any system writes.
std::string_view take_line(std::string_view& rest) {
  const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
  const std::string_view line = trimmed(rest.substr(0, end));
  const bool has_two = end + 1 < rest.size() && rest[end] == '\r' && rest[end + 1] == '\n';
  rest.remove_prefix(std::min(end + (has_two ? 2 : 1), rest.size()));
  return line;
}

// The last line before the first values, with its line number.
struct LineBefore {
  std::string_view words;
  int line = 0;
  bool is_remark = false;
};

bool ends_empty(const std::vector<std::string>& row) {
  return row.size() > 1 && row.back().empty();
}

void take_names(const LineBefore& before, ColumnText& columns) {
  const std::size_t n_columns = columns.rows.front().size();
  for (const char delimiter : {columns.delimiter, delimiter_of(before.words)}) {
    std::vector<std::string> names = split(before.words, delimiter);
    if (ends_empty(names)) names.pop_back();
    const bool has_last = ends_empty(columns.rows.front()) && names.size() + 1 == n_columns;
    if (names.size() != n_columns && !has_last) continue;
    columns.names = std::move(names);
    columns.names_in_remark = before.is_remark;
    return;
  }
  if (before.is_remark || before.words.empty()) return;
  throw InputError({columns.file, before.line},
                   "\"" + std::string(before.words.substr(0, 60)) + "\" does not name the " +
                       counted(static_cast<std::int64_t>(n_columns), "column") +
                       " of the lines below it",
                   "name each column, between the same marks as the numbers; # makes it a remark");
}

// A delimiter behind the last column parts nothing.
void drop_last_delimiters(ColumnText& columns) {
  const bool has_names = !columns.names.empty();
  if (!has_names && !std::all_of(columns.rows.begin(), columns.rows.end(), ends_empty)) return;
  for (std::vector<std::string>& row : columns.rows)
    if (ends_empty(row) && (!has_names || row.size() == columns.names.size() + 1)) row.pop_back();
}

// The line without a remark at its end: # between blanks begins a remark, PT#5 is a word.
std::string_view before_remark(std::string_view line) {
  const std::size_t at = line.find(" #");
  const bool is_remark = at != line.npos && (at + 2 == line.size() || line[at + 2] == ' ');
  return is_remark ? line.substr(0, at) : line;
}

}  // namespace

void check_encoding(const std::string& text, const std::string& file) {
  const std::string command = "iconv -f UTF-16 -t UTF-8 " + command_words(file) + " > columns.csv";
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError({file}, "is written in UTF-16, expected UTF-8", command);
  if (text.find('\0') != std::string::npos)
    throw InputError({file}, "is not plain text (UTF-16, or binary), expected columns of numbers",
                     "save it as CSV in UTF-8; of UTF-16: " + command);
}

ColumnText parse_columns(const std::string& text, const std::string& file) {
  check_encoding(text, file);
  require_memory_for_words(text, file);
  ColumnText columns;
  columns.file = file;
  LineBefore before;
  std::string_view rest = without_mark(text);
  for (int number = 1; !rest.empty(); ++number) {
    std::string_view line = take_line(rest);
    const std::size_t mark = remark_mark(line);
    const std::string_view words = trimmed(mark > 0 ? line.substr(mark) : before_remark(line));
    if (words.empty() || (mark > 0 && (!columns.rows.empty() || holds_value(words)))) continue;
    if (columns.rows.empty() && !holds_value(words)) {
      if (mark == 0 || before.words.empty() || before.is_remark) before = {words, number, mark > 0};
      continue;
    }
    if (columns.rows.empty()) columns.delimiter = delimiter_of(words);
    columns.rows.push_back(split(words, columns.delimiter));
    columns.line.push_back(number);
  }
  if (columns.rows.empty()) throw InputError({file}, "holds no line with a number");
  take_names(before, columns);
  drop_last_delimiters(columns);
  return columns;
}

bool parse_decimal(std::string word, double& value) {
  const std::size_t comma = word.find(',');
  if (comma == word.npos) return parse_double(word, value);
  if (word.find_first_of(",.", comma + 1) != word.npos || word.find('.') < comma) return false;
  word[comma] = '.';
  return parse_double(word, value);
}

bool parse_number(const ColumnText& columns, const std::string& word, double& value) {
  return columns.delimiter == ',' ? parse_double(word, value) : parse_decimal(word, value);
}

std::string plain_name(const std::string& name) {
  std::string plain, inside;  // inside: of brackets
  bool is_inside = false;
  const auto end_brackets = [&] {
    for (const std::string_view unit : {"m", "metres", "meters", "deg", "degrees", "degree", "gon",
                                        "grad", "gradians", "neugrad"})
      if (inside == unit) inside.clear();
    plain += inside;
    inside.clear();
    is_inside = false;
  };
  for (const char c : lower(name)) {
    if (c == ')' || c == ']') end_brackets();
    if (c == '(' || c == '[') is_inside = true;
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) (is_inside ? inside : plain) += c;
  }
  end_brackets();
  for (const std::string_view unit : {"degrees", "deg"})
    if (plain.size() > unit.size() && plain.ends_with(unit))
      plain.resize(plain.size() - unit.size());
  return plain;
}

int find_column(const ColumnText& columns, const std::vector<std::string>& wanted) {
  for (const std::string& name : wanted)
    for (std::size_t c = 0; c < columns.names.size(); ++c)
      if (plain_name(columns.names[c]) == name) return static_cast<int>(c);
  return -1;
}

std::string list_of_names(const ColumnText& columns) {
  std::string all;
  for (const std::string& name : columns.names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

}  // namespace talus
