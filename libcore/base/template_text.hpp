// libcore/base/template_text.hpp: public
// Fills a text file with marks: {{name}} anywhere in a line is a value; the lines between {{#name}}
// and {{/name}}, each alone on its line, are a part that is kept or left out.
// in:    the template, values and parts by name
// out:   the text; a mark without a value, or a value without a mark, is an error
#pragma once

#include <map>
#include <string>

namespace talus {

struct TemplateMarks {
  std::map<std::string, std::string> values;  ///< may be of several lines, without the last newline
  std::map<std::string, bool> parts;          ///< whether the part is kept
};

/// Values are put in as they are: marks in them are not looked for. A value whose part is left out
/// may be missing. Throws InputError for marks that are unknown, parts that are not closed in
/// order, and values or parts that the template does not use; `name` says which template.
[[nodiscard]] std::string filled_template(const std::string& name, const std::string& text,
                                          const TemplateMarks& marks);

}  // namespace talus
