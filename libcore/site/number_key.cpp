// Numeric keys of a site by name, for draws to read and set.
#include "site/number_key.hpp"

#include <cmath>

#include "base/error.hpp"
#include "site/site_keys.hpp"

namespace talus {
namespace {

NumberKey read_number(const KeyOf<ConstField>& row) {
  NumberKey key;
  key.range = row.range;
  if (const auto* number = std::get_if<const double*>(&row.field))
    key.kind = NumberKey::number, key.value = **number;
  else if (const auto* whole = std::get_if<const std::int64_t*>(&row.field))
    key.kind = NumberKey::whole_number, key.value = static_cast<double>(**whole);
  return key;
}

}  // namespace

std::optional<NumberKey> number_key(const Site& site, const std::string& path) {
  std::optional<NumberKey> found;
  for (const auto& section : sections_in(site))
    for (const auto& row : section.keys)
      if (path_of(section.group, section.name) + "." + row.name == path) found = read_number(row);
  return found;
}

void set_number(Site& site, const std::string& path, double value, const ValueSource& source) {
  bool is_set = false;
  for (const auto& section : sections_in(site))
    for (const auto& row : section.keys) {
      if (path_of(section.group, section.name) + "." + row.name != path) continue;
      if (const auto* number = std::get_if<double*>(&row.field))
        **number = value, is_set = true;
      else if (const auto* whole = std::get_if<std::int64_t*>(&row.field))
        **whole = std::llround(value), is_set = true;
    }
  TALUS_ASSERT(is_set);
  if (is_set) site.sources[path] = source;
}

std::vector<std::string> number_keys(const Site& site) {
  std::vector<std::string> paths;
  for (const auto& section : sections_in(site))
    for (const auto& row : section.keys)
      if (read_number(row).kind != NumberKey::other)
        paths.push_back(path_of(section.group, section.name) + "." + row.name);
  return paths;
}

}  // namespace talus
