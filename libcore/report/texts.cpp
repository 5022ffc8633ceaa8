#include "report/texts.hpp"

#include <algorithm>
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

std::string as_list(const std::set<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "{" : ", {") + name + "}";
  return out.empty() ? "none" : out;
}

}  // namespace

void Texts::add(const std::string& key, Entry entry) {
  if (names_in(entry.texts).count("") > 0)
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
    if (own == entries_.end()) {
      const std::string nearest = nearest_name(key, known);
      throw InputError(where, "is not a key of these texts",
                       nearest.empty() ? "the file that is shipped has all keys"
                                       : "did you mean " + nearest + "?");
    }
    if (entry.is_list != own->second.is_list ||
        (entry.is_list && entry.texts.size() != own->second.texts.size()))
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
        throw InputError(where, "has {" + name + "}, which is no value of this text",
                         "its values: " + as_list(names));
  }
  std::vector<std::string> missing;
  for (auto& [key, entry] : entries_)
    if (const auto at = other.entries_.find(key); at != other.entries_.end())
      entry = at->second;
    else
      missing.push_back(key);
  return missing;
}

std::string Texts::of(const std::string& key, Values values) const {
  const std::string& text = entries_.at(key).texts.at(0);
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', done)) {
    const std::string_view name = name_at(text, at);
    const auto* const value = std::find_if(values.begin(), values.end(),
                                           [&name](const auto& v) { return v.first == name; });
    TALUS_ASSERT(value != values.end());
    out += text.substr(done, at - done);
    if (value != values.end()) out += value->second;
    done = at + name.size() + 2;
  }
  return out + text.substr(done);
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
