#include "site/number_key.hpp"

#include <cmath>
#include <type_traits>

#include "base/error.hpp"

namespace talus {
namespace {

// Calls take(path, section, row) for each key of each section that stands in the site.
template <class SiteType, class Take>
void for_each_key(SiteType& site, const Take& take) {
  for_each_section(site, [&take](const char* group, const std::string& name, auto& section) {
    for (const auto& row : keys_of<std::remove_cvref_t<decltype(section)>>())
      take(path_of(group, name) + "." + row.name, section, row);
  });
}

template <class Section>
NumberKey read_number(const Section& section, const SiteKey<Section>& row) {
  NumberKey key;
  key.range = row.range;
  if (const auto* field = std::get_if<double Section::*>(&row.field))
    key.kind = NumberKey::number, key.value = section.**field;
  else if (const auto* whole = std::get_if<std::int64_t Section::*>(&row.field))
    key.kind = NumberKey::whole_number, key.value = static_cast<double>(section.**whole);
  return key;
}

}  // namespace

std::optional<NumberKey> number_key(const Site& site, const std::string& path) {
  std::optional<NumberKey> found;
  for_each_key(site, [&](const std::string& at, const auto& section, const auto& row) {
    if (at == path) found = read_number(section, row);
  });
  return found;
}

void set_number(Site& site, const std::string& path, double value, const ValueSource& source) {
  bool is_set = false;
  for_each_key(site, [&](const std::string& at, auto& section, const auto& row) {
    using Section = std::remove_reference_t<decltype(section)>;
    if (at != path) return;
    if (const auto* field = std::get_if<double Section::*>(&row.field))
      section.** field = value, is_set = true;
    else if (const auto* whole = std::get_if<std::int64_t Section::*>(&row.field))
      section.** whole = std::llround(value), is_set = true;
  });
  TALUS_ASSERT(is_set);
  if (is_set) site.sources[path] = source;
}

std::vector<std::string> number_keys(const Site& site) {
  std::vector<std::string> paths;
  for_each_key(site, [&](const std::string& at, const auto& section, const auto& row) {
    if (read_number(section, row).kind != NumberKey::other) paths.push_back(at);
  });
  return paths;
}

}  // namespace talus
