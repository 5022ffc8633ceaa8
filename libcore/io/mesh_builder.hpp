// libcore/io/mesh_builder.hpp
// Collector for the parsers of mesh formats: vertices as in the file, polygons checked.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/printable.hpp"
#include "base/text.hpp"
#include "io/mesh.hpp"

namespace talus {

class MeshBuilder {
 public:
  void add_vertex(const Vec3& p, const Where& where);
  /// Vertices by their number in the file, from 0.
  void add_polygon(const std::vector<std::int64_t>& file_vertices, const Where& where);
  /// Begins an object, or a group of the last object.
  void start_object(const std::string& name);
  void start_group(const std::string& name, int part = -1);
  [[nodiscard]] std::int64_t n_file_vertices() const {
    return static_cast<std::int64_t>(mesh_.surface.vertices.size());
  }
  /// Throws InputError when it has no face.
  [[nodiscard]] Mesh finished(const std::string& path);

 private:
  Mesh mesh_;
};

/// Words and lines of a text format, with the line number for messages.
class TextReader {
 public:
  TextReader(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  /// The next line without its end, false at the end of the text.
  bool next_line(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    at_ = end + 1;
    ++line_;
    return true;
  }
  /// The next word, over lines and # comments; throws InputError at the end of the text.
  std::string_view next_word() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (is_space(c))
        line_ += c == '\n', ++at_;
      else
        break;
    }
    if (at_ >= text_.size()) throw InputError(where(), "the file ends early");
    std::size_t end = at_;
    while (end < text_.size() && !is_space(text_[end])) ++end;
    const std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    return word;
  }
  double next_number() {
    const std::string_view word = next_word();
    double value = 0;
    if (!parse_double(word, value))
      throw InputError(where(), "\"" + printable(word.substr(0, 40)) + "\" is not a number");
    return value;
  }
  /// A whole number from 0 to `most`.
  std::int64_t next_count(std::int64_t most) {
    const double value = next_number();
    if (!(value >= 0 && value <= static_cast<double>(most)) || value != std::floor(value))
      throw InputError(where(), "found " + talus::text(value) +
                                    ", expected a whole number from 0 to " + std::to_string(most));
    return static_cast<std::int64_t>(value);
  }
  /// Bytes that are left, an upper bound of how many entries can follow.
  [[nodiscard]] std::int64_t n_left() const {
    return static_cast<std::int64_t>(text_.size() - std::min(at_, text_.size()));
  }
  void skip_line() {
    std::string_view ignored;
    static_cast<void>(next_line(ignored));
  }
  [[nodiscard]] std::size_t at() const { return at_; }
  [[nodiscard]] Where where() const { return {path_, line_ + 1}; }
  [[nodiscard]] Where where_of_line() const { return {path_, line_}; }
  static bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
  }

 private:
  std::string_view text_;
  std::string path_;
  std::size_t at_ = 0;
  int line_ = 0;
};

[[nodiscard]] inline std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at < line.size();) {
    while (at < line.size() && TextReader::is_space(line[at])) ++at;
    const std::size_t begin = at;
    while (at < line.size() && !TextReader::is_space(line[at])) ++at;
    if (at > begin) words.push_back(line.substr(begin, at - begin));
  }
  return words;
}

}  // namespace talus
