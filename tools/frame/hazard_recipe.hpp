// tools/frame/hazard_recipe.hpp
// Where the recipe of the hazard classes of a site stands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// Names of share/hazard that `[hazard] recipe` may take.
inline const std::vector<std::string> shipped_recipes = {"switzerland_ti"};

/// Path of the file that `[hazard] recipe` names; none where it is one of shipped_recipes. Throws
/// InputError where it is neither.
[[nodiscard]] std::optional<std::string> recipe_file(const Site& site);

}  // namespace talus
