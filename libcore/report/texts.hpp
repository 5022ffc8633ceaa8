// libcore/report/texts.hpp: public
// The words of a page, each under its key: an office rewords or translates them without compiling.
// in:    TOML, a section a part of the page: texts, and lists of texts (the heads of a table)
// out:   HTML, values in place of {name}
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace talus {

class Texts {
 public:
  /// One text, or a list of them.
  struct Entry {
    std::vector<std::string> texts;
    bool is_list = false;
    int line = 0;  ///< of the file
  };

  /// None yet; `path` is the file of the texts.
  explicit Texts(std::string path) : path_(std::move(path)) {}
  /// Throws InputError for a brace that begins no {name}.
  void add(const std::string& key, Entry entry);

  /// Takes the texts of `other` in place of its own. Returns the keys that `other` lacks. Throws
  /// InputError for a key (but in [said]), a kind, a length of a list or a {name} that is not here
  /// too. `page.sections` may have any length: sections that it lacks are not shown.
  std::vector<std::string> replace_by(const Texts& other);

  /// Where rocks fall one by one: each text KEY_rocks takes the place of KEY.
  void speak_of_rocks();

  /// {name} and its value, as HTML.
  using Values = std::initializer_list<std::pair<std::string_view, std::string>>;
  [[nodiscard]] std::string of(const std::string& key, Values values = {}) const;
  /// The same; `value_of` gives the value of a name.
  [[nodiscard]] std::string filled(
      const std::string& key, const std::function<std::string(const std::string&)>& value_of) const;
  [[nodiscard]] bool has(const std::string& key) const { return entries_.contains(key); }

  /// Words of a result in the page's language. Section [said] has them, in English with {name}
  /// where they differ, each with its translation; words that it lacks stay in English.
  [[nodiscard]] std::string said(const std::string& words) const;
  /// A number as this language writes it: [number] has the decimal sign and the separator of
  /// thousands.
  [[nodiscard]] std::string number(const std::string& text) const;

  /// One of two texts by a number, which is their {n}.
  [[nodiscard]] std::string counted(std::int64_t n, const std::string& one,
                                    const std::string& several) const;
  [[nodiscard]] const std::vector<std::string>& list(const std::string& key) const;

 private:
  std::string path_;
  std::map<std::string, Entry> entries_;  ///< by "section.key"
};

/// Of a file's content. A line break within a text counts as a space. Throws InputError with the
/// line for content that is not TOML, a value that is not text, or a brace that begins no {name}.
[[nodiscard]] Texts parse_texts(const std::string& content, const std::string& path);

}  // namespace talus
