// Compares names of layers with patterns.
#include "import/layer_names.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cctype>

#include "base/text.hpp"

namespace talus {

std::vector<std::string> parted(const std::string& list, char sign) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(sign, begin), list.size());
    std::string word = list.substr(begin, end - begin);
    word.erase(0, word.find_first_not_of(' '));
    word.erase(word.find_last_not_of(' ') + 1);
    if (!word.empty()) words.push_back(word);
    begin = end + 1;
  }
  return words;
}

bool is_pattern(const std::string& name) { return name.find_first_of("*?") != std::string::npos; }

bool matches(const std::string& pattern, const std::string& name) {
  return pattern == name || (is_pattern(pattern) && fnmatch(pattern.c_str(), name.c_str(), 0) == 0);
}

bool names_field(const std::string& filter, const std::string& field) {
  const std::string text = lower(filter), word = lower(field);
  const auto is_letter = [&text](std::size_t i) {
    return i < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    if (!is_letter(at + word.size()) && (at == 0 || !is_letter(at - 1))) return true;
  return false;
}

std::string hint_to_choose(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  const std::string part = "|layername=", one = "put \"" + part + names[0] + "\" behind the file";
  if (names.size() < 2) return one;
  return one + "; several: \"" + part + names[0] + "," + names[1] + "\"; all: \"" + part + "*\"";
}

}  // namespace talus
