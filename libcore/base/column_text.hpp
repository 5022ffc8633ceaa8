// libcore/base/column_text.hpp: public
// Text files of columns as other programs write them: any delimiter, with or without a line of
// names, remarks, a byte order mark.
// in:    the text of a file
// out:   rows of words with their lines, and the names of the columns where the file has some
#pragma once

#include <string>
#include <vector>

namespace talus {

struct ColumnText {
  std::string file;                            ///< path as messages name it
  char delimiter = ' ';                        ///< ; tab | , or a blank: any number of blanks
  std::vector<std::string> names;              ///< of the columns; empty: the file has none
  bool names_in_remark = false;                ///< the names are in a remark
  std::vector<std::vector<std::string>> rows;  ///< may differ in length
  std::vector<int> line;                       ///< of each row, from 1
};

/// Throws InputError, with the command that corrects it, for text that is UTF-16 or none.
void check_encoding(const std::string& text, const std::string& file);

/// The delimiter is the first semicolon, tab, bar or comma in the first line with a number; without
/// one, columns are separated by blanks (also in 180,7 21,6). Names are the last line without a
/// number before that line: as many words as there are columns, or a remark of as many words. A
/// remark is a line that begins with # * ! % or //, and the end of a line after a # between blanks.
/// Words may be in double quotes. Throws InputError for UTF-16, text without a row, and a line of
/// words before the rows that does not name the columns.
[[nodiscard]] ColumnText parse_columns(const std::string& text, const std::string& file);

/// A number with a decimal point, or with one decimal comma. False for anything else.
[[nodiscard]] bool parse_decimal(std::string word, double& value);

/// The same; a comma is not a decimal mark where commas separate the columns.
[[nodiscard]] bool parse_number(const ColumnText& columns, const std::string& word, double& value);

/// The name without its unit, blanks, marks and capitals: "Dip dir. (deg)" is "dipdir".
[[nodiscard]] std::string plain_name(const std::string& name);

/// The column with the first of the `wanted` plain names that there is; -1: none.
[[nodiscard]] int find_column(const ColumnText& columns, const std::vector<std::string>& wanted);

/// "Dip dir., Dip".
[[nodiscard]] std::string list_of_names(const ColumnText& columns);

}  // namespace talus
