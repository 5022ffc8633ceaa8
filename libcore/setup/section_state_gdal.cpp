#include "setup/section_state_gdal.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/file_paths.hpp"
#include "base/sha256.hpp"
#include "io/data_files_gdal.hpp"
#include "site/section_digest.hpp"

namespace talus {
namespace fs = std::filesystem;
namespace {

bool is_wanted(const std::string& section, const std::vector<std::string>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&section](const std::string& name) {
    return section == name || section.starts_with(name + ".");
  });
}

std::string without_quotes(const std::string& value) {
  const bool is_quoted = value.size() > 1 && (value.front() == '"' || value.front() == '\'');
  return is_quoted ? value.substr(1, value.size() - 2) : value;
}

// The files of the data set of a value beside the one that section_digest() counts; none of a file
// that stands alone.
std::set<std::string> further_files(const Site& site, const EffectiveValue& value) {
  const std::string name = without_quotes(value.value);
  if (!value.key.ends_with("file") || name.empty() || names_layers_file(site, name)) return {};
  const std::string path = resolved(site, name), file = file_of(path);
  if (file.empty() || is_virtual(file)) return {};
  std::set<std::string> files;
  for (const std::string& member : data_files(file))
    if (fs::is_regular_file(member)) files.insert(member);
  files.erase(path.substr(0, path.find('|')));
  return files;
}

}  // namespace

std::string section_state(const Site& site, const std::vector<std::string>& sections) {
  const std::string digest = section_digest(site, sections);
  Sha256 hash;
  hash.add(digest.data(), digest.size());
  bool is_all = true;
  for (const EffectiveValue& value : effective_values(site)) {
    if (!is_wanted(value.section, sections)) continue;
    for (const std::string& file : further_files(site, value)) {
      const std::string sha256 = sha256_of_file(file);
      hash.add(sha256.data(), sha256.size());
      is_all = false;
    }
  }
  return is_all ? digest : hash.hex().substr(0, 16);
}

}  // namespace talus
