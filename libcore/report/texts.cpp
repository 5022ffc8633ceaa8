// The words of a page by key, with values filled in, and their translations.
#include "report/texts.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

// The name after the brace at `at`; empty where none begins.
std::string_view name_at(std::string_view text, std::size_t at) {
  const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_", at + 1);
  return end == std::string_view::npos || text[end] != '}' ? std::string_view()
                                                           : text.substr(at + 1, end - at - 1);
}

std::set<std::string> names_in(const std::vector<std::string>& texts) {
  std::set<std::string> names;
  for (const std::string& text : texts)
    for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1))
      names.emplace(name_at(text, at));
  return names;
}

const std::string said_section = "said.";

// Letters of a pattern that are not of a {name}.
std::size_t n_fixed(const std::string& pattern) {
  std::size_t n = pattern.size();
  for (std::size_t at = pattern.find('{'); at != std::string::npos; at = pattern.find('{', at + 1))
    n -= name_at(pattern, at).size() + 2;
  return n;
}

// Parts of `words` where `pattern` has each {name}; none where they differ otherwise.
std::optional<std::map<std::string, std::string>> values_in(const std::string& words,
                                                            const std::string& pattern) {
  std::map<std::string, std::string> values;
  std::size_t at = 0, done = 0;
  for (std::size_t open = pattern.find('{'); open != std::string::npos;) {
    const std::string before = pattern.substr(done, open - done);
    if (words.compare(at, before.size(), before) != 0) return std::nullopt;
    at += before.size();
    const std::string name(name_at(pattern, open));
    done = open + name.size() + 2;
    open = pattern.find('{', done);
    const std::string behind = pattern.substr(done, open - done);
    const bool is_last = open == std::string::npos;
    const std::size_t end = behind.empty()                       ? words.size()
                            : is_last && words.ends_with(behind) ? words.size() - behind.size()
                                                                 : words.find(behind, at + 1);
    if (end == std::string::npos || end <= at || (is_last && end + behind.size() != words.size()))
      return std::nullopt;
    values[name] = words.substr(at, end - at);
    at = end;
  }
  return values;
}

// Of a text like 0.2.0, which is not a number.
bool is_version(const std::string& text, std::size_t at) {
  constexpr const char* of_numbers = "0123456789.";
  const std::size_t before = text.find_last_not_of(of_numbers, at),
                    end = std::min(text.find_first_not_of(of_numbers, at), text.size());
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                    text.begin() + static_cast<std::ptrdiff_t>(end), '.') > 1;
}

std::string as_list(const std::set<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "{" : ", {") + name + "}";
  return out.empty() ? "none" : out;
}

}  // namespace

void Texts::add(const std::string& key, Entry entry) {
  const std::set<std::string> names = names_in(entry.texts);
  if (key.starts_with(said_section))
    for (const std::string& name : names)
      if (names_in({key}).count(name) == 0)
        throw InputError({path_, entry.line, key}, "has {" + name + "}, which the words have not",
                         "the same names on both sides");
  if (names.count("") > 0)
    throw InputError({path_, entry.line, key}, "has a brace that begins no {name}",
                     "names have small letters, digits and _; a brace itself is &#123;");
  entries_[key] = std::move(entry);
}

std::vector<std::string> Texts::replace_by(const Texts& other) {
  std::vector<std::string> known;
  for (const auto& [key, entry] : entries_) known.push_back(key);
  for (const auto& [key, entry] : other.entries_) {
    const Where where{other.path_, entry.line, key};
    const auto own = entries_.find(key);
    if (key.starts_with(said_section)) continue;
    if (own == entries_.end()) {
      const std::string nearest = nearest_name(key, known);
      throw InputError(where, "is not a key of these texts",
                       nearest.empty() ? "the file that is shipped has all keys"
                                       : "did you mean " + nearest + "?");
    }
    if (entry.is_list != own->second.is_list ||
        (entry.is_list && key != "page.sections" && entry.texts.size() != own->second.texts.size()))
      throw InputError(
          where,
          (entry.is_list ? "is a list of " + talus::counted(std::ssize(entry.texts), "text")
                         : std::string("is one text")) +
              ", expected " +
              (own->second.is_list
                   ? "a list of " + talus::counted(std::ssize(own->second.texts), "text")
                   : "one text"),
          "write as many as the file that is shipped");
    const std::set<std::string> names = names_in(own->second.texts);
    for (const std::string& name : names_in(entry.texts))
      if (names.count(name) == 0)
        throw InputError(where, "has {" + name + "}, which is not a value of this text",
                         "its values: " + as_list(names));
  }
  std::vector<std::string> missing;
  for (auto& [key, entry] : entries_)
    if (const auto at = other.entries_.find(key); at != other.entries_.end())
      entry = at->second;
    else if (!key.starts_with(said_section))
      missing.push_back(key);
  for (const auto& [key, entry] : other.entries_)
    if (key.starts_with(said_section)) entries_.insert_or_assign(key, entry);
  return missing;
}

void Texts::speak_of_rocks() {
  constexpr std::string_view of_rocks = "_rocks";
  for (const auto& [key, entry] : entries_)
    if (key.ends_with(of_rocks)) entries_.at(key.substr(0, key.size() - of_rocks.size())) = entry;
}

std::string Texts::of(const std::string& key, Values values) const {
  return filled(key, [&](const std::string& name) {
    const auto* const value = std::find_if(values.begin(), values.end(),
                                           [&name](const auto& v) { return v.first == name; });
    TALUS_ASSERT(value != values.end());
    return value == values.end() ? std::string() : value->second;
  });
}

std::string Texts::filled(const std::string& key,
                          const std::function<std::string(const std::string&)>& value_of) const {
  const std::string& text = entries_.at(key).texts.at(0);
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', done)) {
    const std::string name(name_at(text, at));
    out += text.substr(done, at - done) + value_of(name);
    done = at + name.size() + 2;
  }
  return out + text.substr(done);
}

std::string Texts::said(const std::string& words) const {
  const auto first = entries_.lower_bound(said_section);
  if (const auto exact = entries_.find(said_section + words); exact != entries_.end())
    return exact->second.texts[0];
  const std::pair<const std::string, Entry>* best = nullptr;
  std::map<std::string, std::string> values;
  for (auto at = first; at != entries_.end() && at->first.starts_with(said_section); ++at) {
    const std::string pattern = at->first.substr(said_section.size());
    if (pattern.find('{') == std::string::npos ||
        (best != nullptr && n_fixed(pattern) <= n_fixed(best->first.substr(said_section.size()))))
      continue;
    if (auto matched = values_in(words, pattern)) {
      best = &*at;
      values = std::move(*matched);
    }
  }
  if (best == nullptr) {
    const bool is_number = words.find_first_not_of("0123456789.,-+e %") == std::string::npos;
    return is_number ? number(words) : words;
  }
  return filled(best->first, [&](const std::string& name) { return said(values[name]); });
}

std::string Texts::number(const std::string& text) const {
  const auto is_digit = [&text](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_between = i > 0 && is_digit(i - 1) && is_digit(i + 1);
    const bool is_group = is_between && is_digit(i + 2) && is_digit(i + 3) && !is_digit(i + 4);
    if (text[i] == '.' && is_between && !is_version(text, i))
      out += of("number.decimal");
    else if (text[i] == ',' && is_group)
      out += of("number.thousands");
    else
      out += text[i];
  }
  return out;
}

std::string Texts::counted(std::int64_t n, const std::string& one,
                           const std::string& several) const {
  return of(n == 1 ? one : several, {{"n", std::to_string(n)}});
}

const std::vector<std::string>& Texts::list(const std::string& key) const {
  const Entry& entry = entries_.at(key);
  TALUS_ASSERT(entry.is_list);
  return entry.texts;
}

}  // namespace talus
