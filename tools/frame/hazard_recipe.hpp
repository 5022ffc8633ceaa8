// tools/frame/hazard_recipe.hpp
// The recipe of the hazard classes of a site.
#pragma once

#include "base/input_log.hpp"
#include "post/hazard/recipe.hpp"
#include "site/site.hpp"

namespace talus {

/// Recipe that `[hazard] recipe` names: a file of share/hazard without its suffix, or a path.
/// Throws InputError where it is neither, and as parse_recipe().
[[nodiscard]] Recipe read_recipe(InputLog& log, const Site& site);

}  // namespace talus
