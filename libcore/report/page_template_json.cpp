// The part of report/page_template.hpp that reads JSON.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/grouped_text.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "report/page_template.hpp"

namespace talus {
namespace {

using Json = nlohmann::ordered_json;

struct Part {
  std::string text;
  int line = 1;  // of the template, where it begins
};

std::map<std::string, Part> parts_of(const std::string& content) {
  std::map<std::string, Part> parts;
  Part* part = nullptr;
  int line = 0;
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = std::min(content.find('\n', at), content.size() - 1);
    ++line;
    if (content.compare(at, 3, "{{@") == 0)
      part = &(parts[content.substr(at + 3, content.find("}}", at) - at - 3)] = {"", line + 1});
    else if (part != nullptr)
      part->text += content.substr(at, end + 1 - at);
    at = end + 1;
  }
  return parts;
}

bool holds(const Json& value) {
  return !value.is_null() && value != Json(false) && value != Json(0) && value != Json("") &&
         !(value.is_structured() && value.empty());
}

std::vector<std::string> split(const std::string& words, char at) {
  std::vector<std::string> out(1);
  for (const char c : words) c == at ? out.emplace_back() : out.back() += c;
  return out;
}

// The entry that a block is filled from.
struct Scope {
  const Json* value;
  Json key;
  int n = 1;
};

class Filler {
 public:
  Filler(std::string name, const std::map<std::string, Part>& parts, const Json& data,
         const Texts& texts)
      : name_(std::move(name)), parts_(parts), texts_(texts), scopes_{{&data, {}}} {}

  std::string fill(const std::string& part) {
    const auto found = parts_.find(part);
    if (found == parts_.end()) fail("has no part " + part);
    const Part* const outer = std::exchange(part_, &found->second);
    std::string out;
    if (fill(0, true, out) != std::string::npos) fail("{{/}} closes nothing");
    part_ = outer;
    return out;
  }

 private:
  // From `at` to the end of the block that it is in: behind its {{/}}, npos at the end of the part.
  std::size_t fill(std::size_t at, bool is_kept, std::string& out) {
    const std::string& text = part_->text;
    while (true) {
      const std::size_t begin = text.find("{{", at);
      if (is_kept) out += text.substr(at, begin - at);
      if (begin == std::string::npos) return begin;
      at_ = begin;
      const std::size_t end = text.find("}}", begin);
      if (end == std::string::npos) fail("a mark has no }}");
      const std::string mark = text.substr(begin + 2, end - begin - 2);
      at = end + 2;
      if (mark == "/") return at;
      if (mark[0] == '#' || mark[0] == '^' || mark[0] == '?')
        at = block(mark, at, is_kept, out);
      else if (is_kept)
        out += value_of(mark);
    }
  }

  std::size_t block(const std::string& mark, std::size_t at, bool is_kept, std::string& out) {
    const std::size_t opened = at_, equals = mark.find('=');
    const bool has_value = equals != std::string::npos, is_negative = mark[0] == '^';
    const bool is_of_members = mark.ends_with(".*");
    const std::string path = mark.substr(1, is_of_members ? mark.size() - 3 : equals - 1);
    std::optional<Json> made;
    const Json* const value = is_kept ? find(path, made) : nullptr;
    std::string unused;
    const auto once = [&](bool is_shown) {
      const std::size_t end = fill(at, is_shown, is_shown ? out : unused);
      at_ = opened;
      if (end == std::string::npos) fail("the block is not closed by {{/}}");
      return end;
    };
    if (!is_kept) return once(false);
    const bool is_so = has_value ? value != nullptr && words_of(*value) == mark.substr(equals + 1)
                                 : value != nullptr && holds(*value);
    if (is_so == is_negative) return once(false);
    if (mark[0] != '#' || has_value || !value->is_structured()) return once(true);
    std::size_t end = at;
    int n = 0;
    const auto with = [&](const Json& entry, Json key) {
      scopes_.push_back({&entry, std::move(key), ++n});
      end = once(true);
      scopes_.pop_back();
    };
    if (value->is_array())
      for (const Json& entry : *value) with(entry, n);
    else if (is_of_members)
      for (const auto& [key, entry] : value->items()) with(entry, key);
    else
      with(*value, nullptr);
    return end;
  }

  // The value at a path, its first name that of the innermost entry that has it; null: none.
  const Json* find(const std::string& path, std::optional<Json>& made) const {
    const Scope& scope = scopes_.back();
    if (path == ".") return scope.value;
    if (path == "@key") return &scope.key;
    if (path == "@n") return &made.emplace(scope.n);
    if (path == "@first") return &made.emplace(scope.n == 1);
    const std::vector<std::string> names = split(path, '.');
    const auto in = std::find_if(scopes_.rbegin(), scopes_.rend(), [&names](const Scope& s) {
      return s.value->is_object() && s.value->contains(names[0]);
    });
    if (in == scopes_.rend()) return nullptr;
    const Json* here = in->value;
    for (const std::string& name : names) {
      const bool is_index = here->is_array() && !name.empty() && std::isdigit(name[0]) != 0 &&
                            std::stoul(name) < here->size();
      if (!is_index && !(here->is_object() && here->contains(name))) return nullptr;
      here = is_index ? &(*here)[std::stoul(name)] : &(*here)[name];
    }
    return here;
  }

  static std::string words_of(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  }

  // "path|format"
  std::string formatted(const std::string& words) const {
    const std::size_t bar = words.find('|');
    const std::string format = bar == std::string::npos ? "" : words.substr(bar + 1);
    std::optional<Json> made;
    const Json* const value = find(words.substr(0, bar), made);
    if (format == "raw" || format == "said") {
      if (value == nullptr || !value->is_string()) return "";
      return format == "raw" ? value->get<std::string>()
                             : xml_escaped(texts_.said(value->get<std::string>()));
    }
    if (value == nullptr || value->is_structured() || value->is_null()) return "&ndash;";
    if (value->is_string()) return xml_escaped(value->get<std::string>());
    if (value->is_boolean()) return texts_.of(value->get<bool>() ? "words.yes" : "words.no");
    return texts_.number(number_text(*value, format));
  }

  std::string number_text(const Json& value, const std::string& format) const {
    const double number = value.get<double>();
    if (format == "percent") return percent(number);
    if (format == "needed") return needed_text(number);
    if (format == "whole") return text(std::round(number), 12);
    if (format == "years") return grouped_text(1 / number);
    const bool has_digits = !format.empty() && std::isdigit(format[0]) != 0;
    if (!format.empty() && !has_digits) fail("format " + format + " is not known");
    return grouped_text(number, value.is_number_integer() ? 9
                                : has_digits              ? std::stoi(format)
                                                          : shown_digits);
  }

  std::string value_of(const std::string& mark) {
    if (mark[0] == '+') return fill(mark.substr(1));
    if (mark[0] != '=' && mark[0] != '*') return formatted(mark);
    const std::vector<std::string> words = split(mark.substr(1), ' ');
    return mark[0] == '*' ? heads(words) : words_with_values(words);
  }

  std::string heads(const std::vector<std::string>& words) const {
    std::string out;
    const std::string kinds = words.size() > 1 ? words[1] : "";
    if (!texts_.has(words[0])) fail("there are no texts " + words[0]);
    for (const std::string& head : texts_.list(words[0])) {
      const std::size_t column = static_cast<std::size_t>(std::count(out.begin(), out.end(), '\n'));
      out += (column < kinds.size() && kinds[column] == 'n' ? "<th class=\"n\">" : "<th>") + head +
             "</th>\n";
    }
    return out;
  }

  std::string words_with_values(const std::vector<std::string>& words) const {
    std::string key = words[0];
    if (const std::size_t at = key.find('@'); at != std::string::npos) {
      std::optional<Json> made;
      const Json* const value = find(key.substr(at + 1), made);
      const std::string name = value == nullptr || value->is_null() ? "" : words_of(*value);
      key = key.substr(0, at) + name;
      if (!texts_.has(key)) return xml_escaped(texts_.said(name));
    }
    if (!texts_.has(key)) fail("there is no text " + key);
    return texts_.filled(key, [&](const std::string& name) {
      for (std::size_t i = 1; i < words.size(); ++i)
        if (words[i].starts_with(name + "=")) return formatted(words[i].substr(name.size() + 1));
      return formatted(name);
    });
  }

  [[noreturn]] void fail(const std::string& finding) const {
    const int line = part_ == nullptr
                         ? 0
                         : part_->line + static_cast<int>(std::count(
                                             part_->text.begin(), part_->text.begin() + at_, '\n'));
    throw InputError({name_, line}, finding, "the marks are on the page of talus-report");
  }

  std::string name_;
  const std::map<std::string, Part>& parts_;
  const Texts& texts_;
  std::vector<Scope> scopes_;
  const Part* part_ = nullptr;
  std::ptrdiff_t at_ = 0;
};

}  // namespace

std::string filled_page(const std::string& name, const std::string& content,
                        const std::string& data_json, const Texts& texts) {
  Json data = Json::parse(data_json);
  const std::map<std::string, Part> parts = parts_of(content);
  Json sections = Json::array();
  for (const std::string& id : texts.list("page.sections")) {
    std::string body = Filler(name, parts, data, texts).fill(id);
    if (body.find_first_not_of(" \n") == std::string::npos) continue;
    sections.push_back({{"id", id},
                        {"nav", texts.of("nav." + id)},
                        {"title", texts.of(id + ".title")},
                        {"body", std::move(body)}});
  }
  data["sections"] = std::move(sections);
  return Filler(name, parts, data, texts).fill("page");
}

}  // namespace talus
