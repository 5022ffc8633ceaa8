// Files that a site file names.
#include "setup/site_files.hpp"

#include <set>

#include "base/file_paths.hpp"

namespace talus {
namespace {

// Keys whose value is the name of a file.
bool names_a_file(const std::string& section, const std::string& key) {
  static const std::set<std::string> keys = {"contours", "breaklines", "spots",         "boundary",
                                             "dem",      "raster",     "ground_raster", "file"};
  if (section == "site" || section == "solver" || section == "output") return false;
  if (section == "hazard") return false;  // a recipe may be a name: file_named()
  return keys.count(key) > 0 || (key.size() > 5 && key.ends_with("_file")) ||
         ((section.starts_with("forest.") || section.starts_with("rockfall.")) &&
          key.ends_with("_raster"));
}

}  // namespace

std::string unquoted(const std::string& toml) {
  return toml.size() >= 2 && (toml[0] == '\'' || toml[0] == '"') ? toml.substr(1, toml.size() - 2)
                                                                 : toml;
}

std::string file_named(const Site& site, const EffectiveValue& value) {
  const bool is_recipe = value.section == "hazard" && value.key == "recipe" &&
                         unquoted(value.value).ends_with(".toml");
  const std::string word = unquoted(value.value);
  const bool is_code = value.section.starts_with("fence_search.") && value.key == "code" &&
                       word != "uni" && word != "onr";
  if (value.value.empty() || !(is_recipe || is_code || names_a_file(value.section, value.key)))
    return "";
  const std::string file = file_of(resolved(site, word));
  return is_virtual(file) ? "" : file;
}

std::vector<std::string> files_named(const Site& site) {
  std::vector<std::string> files;
  for (const EffectiveValue& value : effective_values(site))
    if (std::string file = file_named(site, value); !file.empty()) files.push_back(std::move(file));
  if (!site.layers_file.empty()) files.push_back(file_of(resolved(site, site.layers_file)));
  if (!site.quantities_file.empty()) files.push_back(resolved(site, site.quantities_file));
  return files;
}

}  // namespace talus
