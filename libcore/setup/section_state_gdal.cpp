// Digest of sections of a site file with the files that they name.
#include "setup/section_state_gdal.hpp"

#include <algorithm>

#include "base/sha256.hpp"
#include "io/data_files_gdal.hpp"
#include "setup/site_files.hpp"

namespace talus {

std::string section_state(const Site& site, const std::vector<std::string>& sections) {
  Sha256 hash;
  const auto is_wanted = [&sections](const std::string& section) {
    return std::any_of(sections.begin(), sections.end(), [&section](const std::string& name) {
      return section == name || section.starts_with(name + ".");
    });
  };
  for (const EffectiveValue& value : effective_values(site)) {
    if (!is_wanted(value.section)) continue;
    const bool is_of_layers = names_layers_file(site, unquoted(value.value));
    const std::string line = value.section + "." + value.key + " = " + value.value + "\n" +
                             (is_of_layers ? "" : digest_of_data(file_named(site, value))) + "\n";
    hash.add(line.data(), line.size());
  }
  for (const auto& [section, digest] : site.layer_digests)
    if (is_wanted(section)) hash.add(digest.data(), digest.size());
  return hash.hex().substr(0, 16);
}

}  // namespace talus
