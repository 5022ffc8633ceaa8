// Classes of an authority's recipe: the matrix of intensity and period, limits of risk, names.
#include "post/hazard/recipe.hpp"

#include <cmath>

#include "base/text.hpp"

namespace talus {
namespace {

std::string list_of_items(const RecipeSource& source) {
  std::string out;
  for (const std::string& item : source.of) out += (out.empty() ? "" : ", ") + item;
  return out;
}

}  // namespace

std::string mark_words(const Recipe& recipe) {
  std::string out = recipe.sources[0].mark;
  for (const RecipeSource& source : recipe.sources)
    if (source.mark != recipe.sources[0].mark)
      out += "; " + list_of_items(source) + " " + source.mark;
  return out;
}

std::string source_words(const Recipe& recipe) {
  std::string out;
  for (const RecipeSource& source : recipe.sources)
    out += (out.empty() ? "" : "; ") + list_of_items(source) + ": " + source.document + ", " +
           source.page + " (" + source.mark + ")";
  return out;
}

std::string period_name(double years) { return text(years < 10 ? years : std::round(years)); }

std::string break_name(const Recipe& recipe, double value) {
  return text(value) + (recipe.by == IntensityBy::block_volume ? "m3" : "kJ");
}

std::string intensity_words(const Recipe& recipe, std::size_t i) {
  const std::string unit = recipe.by == IntensityBy::block_volume ? " m3" : " kJ";
  const std::string name = recipe.intensities[i];
  if (recipe.breaks.empty()) return name;
  if (i == 0) return name + ", up to " + text(recipe.breaks[0]) + unit;
  if (i == recipe.breaks.size()) return name + ", above " + text(recipe.breaks.back()) + unit;
  return name + ", " + text(recipe.breaks[i - 1]) + " - " + text(recipe.breaks[i]) + unit;
}

int intensity_at(const Recipe& recipe, std::span<const double> rates, double period) {
  int intensity = 0;
  for (std::size_t i = 0; i <= recipe.breaks.size(); ++i)
    if (rates[i] * period >= 1 - rate_rounding) intensity = static_cast<int>(i) + 1;
  return intensity;
}

ClassChoice class_of(const Recipe& recipe, std::span<const double> rates) {
  ClassChoice worst{-1, 0};
  for (std::size_t t = 0; t < recipe.return_periods.size(); ++t) {
    const int intensity = intensity_at(recipe, rates, recipe.return_periods[t]);
    if (intensity == 0) continue;
    const MatrixCell& cell = recipe.matrix[static_cast<std::size_t>(intensity) - 1][t];
    const int chosen = cell.of_side[static_cast<std::size_t>(recipe.side)];
    const int code = chosen < 0 ? 0 : recipe.classes[static_cast<std::size_t>(chosen)].code;
    if (code > worst.code || (code == worst.code && cell.number > worst.number))
      worst = {code, cell.number};
  }
  if (worst.code > 0) return worst;
  if (worst.code == 0 || !(rates[0] > 0) || recipe.beyond < 0) return {};
  return {recipe.classes[static_cast<std::size_t>(recipe.beyond)].code, 0};
}

}  // namespace talus
