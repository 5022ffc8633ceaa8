// Annual probability of death of the person most at risk at an object, and expected deaths.
#include "post/hazard/risk.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

Where where_of(const Site& site, const ObjectSettings& object) {
  return {site.file, object.line_number, "object." + object.name};
}

std::string names_of_intensities(const Recipe& recipe) {
  std::string out;
  for (std::size_t i = 0; i < recipe.intensities.size(); ++i)
    out += (i > 0 ? "; " : "") + intensity_words(recipe, i);
  return out;
}

void check_object(const Site& site, const Recipe& recipe, const ObjectSettings& object) {
  const Where where = where_of(site, object);
  const std::string by = "recipe " + recipe.name + " is of risk, and the object has no ";
  if (std::isnan(object.presence))
    throw InputError(where, by + "presence",
                     "give the share of the time that the one most at risk is where rocks hit: "
                     "presence = 0.75 in a house");
  if (object.vulnerability.empty())
    throw InputError(where, by + "vulnerability",
                     "give the probability of death of who is hit, for each of: " +
                         names_of_intensities(recipe));
  if (std::isnan(object.persons_per_day))
    throw InputError(where, by + "persons_per_day",
                     "give how many persons, also in vehicles, are there so long in a day: "
                     "persons_per_day = 4");
  const std::vector<double>& v = object.vulnerability;
  if (v.size() != recipe.intensities.size())
    throw InputError(where,
                     "vulnerability has " + counted(static_cast<std::int64_t>(v.size()), "number") +
                         ", recipe " + recipe.name + " has " +
                         counted(static_cast<std::int64_t>(recipe.intensities.size()), "intensity"),
                     "one for each of: " + names_of_intensities(recipe));
  if (!std::is_sorted(v.begin(), v.end()))
    throw InputError(where, "vulnerability falls with the intensity",
                     "write the numbers from the weakest intensity to the strongest: " +
                         names_of_intensities(recipe));
}

std::size_t class_of_risk(const Recipe& recipe, double risk) {
  std::size_t i = 0;
  while (i < recipe.risk_limits.size() && risk >= recipe.risk_limits[i]) ++i;
  return recipe.risk_classes[i];
}

}  // namespace

void check_exposure(const Site& site, const Recipe& recipe,
                    const std::vector<HazardClass>& classes) {
  if (!is_of_risk(recipe)) return;
  if (site.objects.empty())
    throw InputError({site.file, 0, "hazard.recipe"},
                     "recipe " + recipe.name + " is of risk, and the site has no object",
                     "add [object.NAME] with its place, presence, vulnerability and "
                     "persons_per_day; or choose a recipe of classes of cells");
  if (classes.empty())
    throw InputError({site.file, 0, "hazard.recipe"},
                     "recipe " + recipe.name +
                         " is of risk, and the site says nowhere how often "
                         "rocks come",
                     "add [hazard.class.NAME] with frequency_per_a");
  for (const ObjectSettings& object : site.objects) check_object(site, recipe, object);
}

std::string unused_exposure(const Site& site, const Recipe& recipe) {
  if (is_of_risk(recipe)) return "";
  std::string names;
  for (const ObjectSettings& object : site.objects)
    if (!std::isnan(object.presence) || !object.vulnerability.empty() ||
        !std::isnan(object.persons_per_day))
      names += (names.empty() ? "" : ", ") + object.name;
  if (names.empty()) return "";
  return "presence, vulnerability and persons_per_day of " + names + " are not used; recipe " +
         recipe.name + " has no [risk]";
}

ObjectRisk risk_of(const Recipe& recipe, const ObjectSettings& object,
                   std::span<const Rate> rates) {
  Rate deaths_of_one;  // a year who is there all the time and never dies
  double before = 0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const double more = object.presence * (object.vulnerability[i] - before);
    before = object.vulnerability[i];
    deaths_of_one.value += more * rates[i].value;
    deaths_of_one.low += more * rates[i].low;
    deaths_of_one.high += more * rates[i].high;
  }
  ObjectRisk out;
  out.individual = {individual_risk(deaths_of_one.value), individual_risk(deaths_of_one.low),
                    individual_risk(deaths_of_one.high)};
  out.deaths = object.persons_per_day * deaths_of_one.value;
  out.kind = class_of_risk(recipe, out.individual.value);
  out.is_certain = !std::isnan(out.individual.low + out.individual.high) &&
                   class_of_risk(recipe, out.individual.low) == out.kind &&
                   class_of_risk(recipe, out.individual.high) == out.kind;
  return out;
}

double individual_risk(double deaths_of_one) { return -std::expm1(-deaths_of_one); }

double death_by(const Recipe& recipe, const ObjectSettings& object, float intensity) {
  std::size_t i = 0;
  while (i < recipe.breaks.size() && intensity > recipe.breaks[i]) ++i;
  return object.presence * object.vulnerability[i];
}

}  // namespace talus
