#include "tools/frame/hazard_recipe.hpp"

#include <algorithm>
#include <filesystem>

namespace talus {

std::optional<std::string> recipe_file(const Site& site) {
  const std::string& name = site.hazard.recipe;
  if (std::find(shipped_recipes.begin(), shipped_recipes.end(), name) != shipped_recipes.end())
    return std::nullopt;
  const std::string path = resolved(site, name);
  if (std::filesystem::exists(path)) return path;
  std::string known;
  for (const std::string& other : shipped_recipes) known += (known.empty() ? "" : ", ") + other;
  throw InputError(where_of(site, "hazard.recipe"),
                   "recipe is \"" + name + "\", which is neither known nor a file",
                   "known: " + known + "; or the path of a file like share/hazard/" +
                       shipped_recipes[0] + ".toml");
}

}  // namespace talus
