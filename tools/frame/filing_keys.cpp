// Data model by which a hazard map is filed, by the keys of [hazard], and whether it can be.
#include "tools/frame/filing_keys.hpp"

#include <cstdio>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/crs_gdal.hpp"

namespace talus {
namespace {

bool is_day(const std::string& date) {
  int year = 0, month = 0, day = 0, end = 0;
  return date.size() == 10 &&
         std::sscanf(date.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &end) == 3 && end == 10 &&
         month >= 1 && month <= 12 && day >= 1 && day <= 31;
}

void check_swiss(const Site& site, const Recipe& recipe, const std::string& crs_wkt) {
  const Where where = where_of(site, "hazard.recipe");
  const std::string way_out = "take a namespace of another kind, which is filed by INSPIRE";
  if (recipe.intensities.size() != swiss_intensities.size() ||
      recipe.classes.size() != swiss_levels.size())
    throw InputError(where,
                     "recipe " + recipe.name + " has " + std::to_string(recipe.intensities.size()) +
                         " and " + std::to_string(recipe.classes.size()) +
                         " as the numbers of intensities and classes, the Swiss model 3 and 4",
                     way_out);
  for (const double period : recipe.return_periods)
    if (period < 1 || period > 10000)
      throw InputError(where,
                       "recipe " + recipe.name + " has a return period of " + text(period) +
                           " years, the Swiss model 1 to 10000",
                       way_out);
  const std::string system = crs_code(crs_wkt);
  if (system != "EPSG:2056" && system != "EPSG:21781")
    throw InputError({site.file, 0, "hazard.namespace"},
                     "is of a canton, and the terrain is in " + crs_name(crs_wkt) +
                         ", expected EPSG:2056 or EPSG:21781",
                     "import the terrain with --t-srs EPSG:2056");
}

}  // namespace

std::string canton_of(const Site& site) {
  static const std::vector<std::string> cantons = {
      "ZH", "BE", "LU", "UR", "SZ", "OW", "NW", "GL", "ZG", "FR", "SO", "BS", "BL",
      "SH", "AR", "AI", "SG", "GR", "AG", "TG", "TI", "VD", "VS", "NE", "GE", "JU"};
  for (const std::string& canton : cantons)
    if (lower(site.hazard.name_space) == lower(canton) + ".ch") return canton;
  return "";
}

void check_filing(const Site& site, const Recipe& recipe, const std::string& crs_wkt) {
  if (!is_filed(site)) return;
  const HazardSettings& h = site.hazard;
  for (const auto& [key, value] :
       {std::pair{"author", h.author}, {"date", h.date}, {"namespace", h.name_space}})
    if (value.empty())
      throw InputError({site.file, 0, "hazard"}, std::string("has no ") + key,
                       "what is filed needs author, date and namespace; or give none of them");
  if (!is_day(h.date))
    throw InputError(where_of(site, "hazard.date"), "date is \"" + h.date + "\"",
                     "write the day as \"2026-05-31\"");
  if (is_of_risk(recipe))
    throw InputError(where_of(site, "hazard.recipe"),
                     "recipe " + recipe.name + " is of risk: there are no areas to be filed",
                     "take author, date and namespace out, or choose a recipe of classes of cells");
  if (!canton_of(site).empty()) check_swiss(site, recipe, crs_wkt);
}

}  // namespace talus
