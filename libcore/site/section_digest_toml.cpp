// What sections of a site file say, as a digest of their effective values
// (site/section_digest.hpp).
#include <algorithm>
#include <filesystem>

#include "base/sha256.hpp"
#include "site/section_digest.hpp"

namespace talus {
namespace {

bool is_in(const std::string& section, const std::string& wanted) {
  return section == wanted || section.starts_with(wanted + ".");
}

std::string without_quotes(const std::string& value) {
  const bool is_quoted = value.size() > 1 && (value.front() == '"' || value.front() == '\'');
  return is_quoted ? value.substr(1, value.size() - 2) : value;
}

// Of a file that a value names; "" where it names none.
std::string digest_of_file(const Site& site, const EffectiveValue& entry) {
  if (!entry.key.ends_with("file") && entry.key != "recipe") return "";
  const std::string name = without_quotes(entry.value);
  if (names_layers_file(site, name)) return "";  // its features count, below
  const std::string path = resolved(site, name.substr(0, name.find('|')));
  std::error_code error;
  return !name.empty() && std::filesystem::is_regular_file(path, error) ? sha256_of_file(path) : "";
}

}  // namespace

std::string section_digest(const Site& site, const std::vector<std::string>& sections) {
  Sha256 hash;
  const auto is_wanted = [&](const std::string& section) {
    return std::any_of(sections.begin(), sections.end(),
                       [&](const std::string& wanted) { return is_in(section, wanted); });
  };
  for (const EffectiveValue& entry : effective_values(site)) {
    if (!is_wanted(entry.section)) continue;
    const std::string line = entry.section + "." + entry.key + " = " + entry.value + "\n" +
                             digest_of_file(site, entry) + "\n";
    hash.add(line.data(), line.size());
  }
  for (const auto& [section, digest] : site.layer_digests)
    if (is_wanted(section)) hash.add(digest.data(), digest.size());
  return hash.hex().substr(0, 16);
}

}  // namespace talus
