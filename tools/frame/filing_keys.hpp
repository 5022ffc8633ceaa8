// tools/frame/filing_keys.hpp
// [hazard] author, date and namespace: by which data model a hazard map is filed, and whether it
// can. refs:  Hazard_Mapping_LV95_V1_2 (BAFU, identifier 166.1, 2017-06-23)
#pragma once

#include <string>
#include <vector>

#include "post/hazard/recipe.hpp"
#include "site/site.hpp"

namespace talus {

/// Of the Swiss model, from the weakest.
inline const std::vector<std::string> swiss_intensities = {"low", "mean", "high"};
inline const std::vector<std::string> swiss_levels = {"residual_hazard", "slight", "mean",
                                                      "substantial"};

[[nodiscard]] inline bool is_filed(const Site& site) {
  return !(site.hazard.author + site.hazard.date + site.hazard.name_space).empty();
}
/// "TI" of "ti.ch", which is filed by the Swiss model; empty where it is not a canton's.
[[nodiscard]] std::string canton_of(const Site& site);

/// Throws InputError where one of the three keys is missing or cannot be, and where the recipe or
/// the coordinate system (WKT) does not fit the model.
void check_filing(const Site& site, const Recipe& recipe, const std::string& crs_wkt);

}  // namespace talus
