// The part of site/site.hpp that writes: effective values, and a site file that reads back.
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string_view>
#include <variant>

#include "base/text.hpp"
#include "site/site_keys.hpp"
#include "site/soils.hpp"

namespace talus {
namespace {

using Texts = std::vector<std::string>;

// --- values as text ----------------------------------------------------------------------------

std::string quoted(const std::string& value) {
  std::ostringstream out;
  out << toml::node_view<const toml::node>(toml::value<std::string>(value));
  return out.str();
}
std::string literal(double value) { return text(value); }
std::string literal(std::int64_t value) { return std::to_string(value); }
std::string literal(bool value) { return value ? "true" : "false"; }
std::string literal(const std::string& value) { return quoted(value); }
std::string literal(const Vec3& p) {
  std::string out = "[" + text(p.x()) + ", " + text(p.y());
  return out + (std::isnan(p.z()) ? "]" : ", " + text(p.z()) + "]");
}
template <class T>
std::string literal(const std::vector<T>& list) {
  std::string out = "[";
  for (const T& entry : list) out += (out.size() > 1 ? ", " : "") + literal(entry);
  return out + "]";
}

bool is_given(double value) { return !std::isnan(value); }
bool is_given(std::int64_t) { return true; }
bool is_given(bool) { return true; }
bool is_given(const std::string& value) { return !value.empty(); }
template <class T>
bool is_given(const std::vector<T>& list) {
  return !list.empty();
}

const char* type_text(double) { return "number"; }
const char* type_text(std::int64_t) { return "whole number"; }
const char* type_text(bool) { return "true or false"; }
const char* type_text(const std::string&) { return "text"; }
const char* type_text(const std::vector<double>&) { return "list of numbers"; }
const char* type_text(const std::vector<Vec3>&) { return "list of points"; }
const char* type_text(const Texts&) { return "list of texts"; }

// --- listing -----------------------------------------------------------------------------------

std::string key_text(const std::string& name) {
  const bool is_bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
  });
  return is_bare ? name : quoted(name);
}

// That a section names; nullptr: none.
const Soil* soil_of(const Keys<ConstField>& keys) {
  for (const auto& key : keys)
    if (key.name == std::string_view("soil"))
      return soil_named(*std::get<const std::string*>(key.field));
  return nullptr;
}

std::string source_of(const Site& site, const Soil* soil, const std::string& path) {
  const auto found = site.sources.find(path);
  if (found == site.sources.end()) return "default";
  const ValueSource& source = found->second;
  if (soil != nullptr && source.kind == ValueSource::from_soil)
    return std::string("soil ") + soil->name + " (" + soil->mark + ")";
  if (source.kind == ValueSource::from_cli) return "cli";
  if (!source.words.empty()) return source.words;
  return "file, line " + std::to_string(source.line);
}

// Empty: not given.
std::string value_text(const ConstField& field) {
  return std::visit(
      [](const auto* value) { return is_given(*value) ? literal(*value) : std::string(); }, field);
}

void describe_keys(const std::string& name, const Keys<ConstField>& keys,
                   std::vector<KeyDescription>& rows) {
  for (const auto& key : keys) {
    const bool has_range = std::isfinite(key.range.low) || std::isfinite(key.range.high);
    rows.push_back({name, key.name,
                    std::visit([](const auto* value) { return type_text(*value); }, key.field),
                    value_text(key.field),
                    *key.choices ? key.choices
                    : has_range  ? text_of(key.range)
                                 : "",
                    key.help});
  }
}

}  // namespace

std::vector<EffectiveValue> effective_values(const Site& site) {
  std::vector<EffectiveValue> values;
  for (const auto& [group, name, keys] : sections_in(site)) {
    const std::string shown = path_of(group, name.empty() ? name : key_text(name));
    const Soil* soil = soil_of(keys);
    for (const auto& key : keys) {
      // how sure the values of a soil are, and where they are from
      const bool has_note = soil != nullptr && key.name == std::string_view("soil");
      values.push_back({shown, key.name, value_text(key.field),
                        source_of(site, soil, path_of(group, name) + "." + key.name),
                        has_note ? std::string(soil->mark) + ": " + soil->source : ""});
    }
  }
  return values;
}

std::string print_config(const Site& site) {
  std::string out, section;
  for (const std::string& name : site.measures) out += measure_comment + name + "\n";
  for (const EffectiveValue& entry : effective_values(site)) {
    if (entry.section != section) out += (section.empty() ? "[" : "\n[") + entry.section + "]\n";
    section = entry.section;
    out += entry.value.empty() ? "# " + entry.key + ": not given\n"
                               : entry.key + " = " + entry.value + "  # " + entry.source + "\n";
    if (!entry.note.empty()) out += "# " + entry.note + "\n";
  }
  return out;
}

std::vector<KeyDescription> site_keys() {
  std::vector<KeyDescription> rows;
  const Site site;
  for_each_group(site, [&rows]<class Group>(const std::string& group, const Group& fields) {
    if constexpr (requires { fields.front(); }) {
      const typename Group::value_type section;
      describe_keys(group + ".NAME", keys_in(section), rows);
    } else {
      describe_keys(group, keys_in(fields), rows);
    }
  });
  return rows;
}

}  // namespace talus
