// Reads the recipe of the hazard classes of a site.
#include "tools/frame/hazard_recipe.hpp"

#include <algorithm>
#include <filesystem>

#include "base/read_file.hpp"
#include "base/words.hpp"
#include "tools/frame/shipped_data.hpp"

namespace talus {

Recipe read_recipe(InputLog& log, const Site& site) {
  const std::string folder = "share/hazard/", suffix = ".toml", name = site.hazard.recipe,
                    shipped = folder + name + suffix;
  std::vector<std::string> known = shipped_names(folder);
  if (std::find(known.begin(), known.end(), shipped) != known.end())
    return parse_recipe(shipped_data(shipped), shipped);
  const std::string path = resolved(site, name);
  if (!std::filesystem::exists(path)) {
    for (std::string& file : known)
      file = file.substr(folder.size(), file.size() - folder.size() - suffix.size());
    throw InputError(
        where_of(site, "hazard.recipe"),
        "recipe is \"" + name + "\", which is neither known nor a file",
        "known: " + list_of(known) + "; or the path of a file like " + folder + known[0] + suffix);
  }
  log.read_also("recipe", path);
  return parse_recipe(read_file(path), path);
}

}  // namespace talus
