// The part of report/texts.hpp that reads the file.
#include <toml++/toml.h>

#include <algorithm>

#include "base/error.hpp"
#include "report/texts.hpp"

namespace talus {
namespace {

// A stretch of white space with a line break in it becomes one space, at the ends none.
std::string in_one_line(const std::string& text) {
  constexpr const char* white = " \t\r\n";
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find_first_not_of(white, i), text.size());
    if (end == i) {
      out += text[i++];
      continue;
    }
    const std::string space = text.substr(i, end - i);
    if (space.find('\n') == std::string::npos)
      out += space;
    else if (i > 0 && end < text.size())
      out += ' ';
    i = end;
  }
  return out;
}

struct TextReader {
  std::string path;
  Texts texts{path};

  // The texts of a section; `of` is its name with a dot.
  void read(const toml::table& table, const std::string& of) {
    for (const auto& [name, node] : table) {
      const std::string key = of + std::string(name.str());
      if (const toml::table* section = node.as_table()) {
        read(*section, key + ".");
        continue;
      }
      Texts::Entry entry{{}, node.is_array(), static_cast<int>(node.source().begin.line)};
      if (const toml::array* list = node.as_array())
        for (const toml::node& part : *list) entry.texts.push_back(text_of(part, key));
      else
        entry.texts.push_back(text_of(node, key));
      texts.add(key, std::move(entry));
    }
  }

  [[nodiscard]] std::string text_of(const toml::node& node, const std::string& key) const {
    if (!node.is_string())
      throw InputError({path, static_cast<int>(node.source().begin.line), key},
                       "is not a text, nor a list of texts", "write it in quotation marks");
    return in_one_line(node.as_string()->get());
  }
};

}  // namespace

Texts parse_texts(const std::string& content, const std::string& path) {
  try {
    TextReader reader{path};
    reader.read(toml::parse(content, path), "");
    return std::move(reader.texts);
  } catch (const toml::parse_error& error) {
    throw InputError({path, static_cast<int>(error.source().begin.line)},
                     std::string(error.description()), "texts must be TOML");
  }
}

}  // namespace talus
