#include "tools/frame/hazard_recipe.hpp"

#include <algorithm>
#include <filesystem>

#include "base/words.hpp"

namespace talus {

std::optional<std::string> recipe_file(const Site& site) {
  const std::string& name = site.hazard.recipe;
  if (std::find(shipped_recipes.begin(), shipped_recipes.end(), name) != shipped_recipes.end())
    return std::nullopt;
  const std::string path = resolved(site, name);
  if (std::filesystem::exists(path)) return path;
  throw InputError(where_of(site, "hazard.recipe"),
                   "recipe is \"" + name + "\", which is neither known nor a file",
                   "known: " + list_of(shipped_recipes) +
                       "; or the path of a file like share/hazard/" + shipped_recipes[0] + ".toml");
}

}  // namespace talus
