// Stability of a mass before it fails, as JSON and in words.
#include "tools/stability/findings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "base/words.hpp"

namespace talus {
namespace {

bool stands(const SafetyFactor& factor) { return factor.holds > 0 && factor.value() >= 1; }

// NaN: beyond those that were tried
double value_of(const SafetyFactor& factor) {
  return std::isfinite(factor.moves) && factor.holds > 0 ? factor.value()
                                                         : std::numeric_limits<double>::quiet_NaN();
}

// "a factor of 1.12", "a factor above 16"
std::string factor_text(const SafetyFactor& factor) {
  if (factor.holds == 0) return "a factor below " + text(factor.moves, 3);
  if (!std::isfinite(factor.moves)) return "a factor above " + text(factor.holds, 3);
  return "a factor of " + text(factor.value(), 3);
}

std::string held_text(const SafetyFactor& factor) {
  return (stands(factor) ? "is held by " : "does not stand, with ") + factor_text(factor);
}

double measured(const Findings& f, double rise) {
  return f.measure == WaterMeasure::below_surface ? f.at_given - rise : f.at_given + rise;
}

// "water in the joints stands 6.4 m above the foot"
std::string water_text(const Findings& f, double rise) {
  const std::string metres = text(std::abs(measured(f, rise)), 2) + " m";
  switch (f.measure) {
    case WaterMeasure::above_foot:
      return "water in the joints stands " + metres + " above the foot";
    case WaterMeasure::in_cracks:
      return "water in the cracks stands " + metres + " above their foot";
    case WaterMeasure::below_surface:
      return "water in the joints rises to " + metres + " below the surface";
    case WaterMeasure::above_given:
      break;
  }
  return "water in the joints stands " + metres + (rise < 0 ? " lower" : " higher") + " than given";
}

std::string dry_sentence(const Findings& f) {
  const SafetyFactor& dry = f.levels.front().found.mass;
  std::string words = "The slope " + held_text(dry) + " when dry";
  if (!stands(dry)) return words;
  return words + (f.mass.fails_at ? "; it fails when " + water_text(f, *f.mass.fails_at)
                                  : "; it stands at every level of the water");
}

std::string first_sentence(const Stability& found) {
  constexpr std::size_t most_named = 8;
  const std::vector<int> first = first_blocks(found);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(first.size(), most_named); ++i)
    names.push_back(std::to_string(first[i]));
  return std::to_string(first.size()) + " of " + counted(std::ssize(found.of_block), "block") +
         " go first, at " + factor_text(found.first) + ": " + list_of(names) +
         (first.size() > most_named ? " ..." : "");
}

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json factor_json(const SafetyFactor& factor) {
  return {{"factor", number(value_of(factor))},
          {"holds", factor.holds},
          {"moves", number(factor.moves)}};
}

Json group_json(const Findings& f, const char* name, SafetyFactor Stability::*of,
                const GroupFound& group, int n_blocks) {
  Json json = {{"group", name},
               {"n_blocks", n_blocks},
               {"factor", factor_json(f.as_given().*of)},
               {"dry", f.has_water ? factor_json(f.levels.front().found.*of) : Json()},
               {"fails_at_m", group.fails_at ? Json(measured(f, *group.fails_at)) : Json()},
               {"shaken", f.shaken ? factor_json(*f.shaken.*of) : Json()}};
  if (f.n_samples > 0) {
    const double share = static_cast<double>(group.n_failed) / f.n_samples;
    const Interval interval = wilson_interval(share, f.n_samples);
    json["drawn"] = {{"samples", f.n_samples},
                     {"failed", group.n_failed},
                     {"probability", share},
                     {"low", interval.low},
                     {"high", interval.high}};
  }
  return json;
}

std::string drawn_sentence(const Findings& f) {
  const double share = static_cast<double>(f.mass.n_failed) / f.n_samples;
  const Interval interval = wilson_interval(share, f.n_samples);
  return "With the drawn strengths it fails in " + percent(share) + " of " +
         counted(f.n_samples, "sample") + " (95 %: " + percent(interval.low) + " to " +
         percent(interval.high) + ")";
}

const char* text_of(WaterMeasure measure) {
  switch (measure) {
    case WaterMeasure::above_foot:
      return "water above the foot [m]";
    case WaterMeasure::below_surface:
      return "depth of the water below the surface [m]";
    case WaterMeasure::in_cracks:
      return "water in the cracks above their foot [m]";
    case WaterMeasure::above_given:
      break;
  }
  return "water higher than given [m]";
}

}  // namespace

WaterMeasure measure_of(const WaterSettings& water) {
  if (!std::isnan(water.depth_m)) return WaterMeasure::below_surface;
  if (!water.raster.empty() || water.surface_m.size() > 1) return WaterMeasure::above_given;
  return water.surface_m.empty() ? WaterMeasure::in_cracks : WaterMeasure::above_foot;
}

std::vector<int> first_blocks(const Stability& found) {
  std::vector<int> blocks;
  for (std::size_t b = 0; b < found.of_block.size(); ++b)
    if (std::isfinite(found.first.moves) && found.of_block[b] <= found.first.moves)
      blocks.push_back(static_cast<int>(b));
  return blocks;
}

std::vector<std::string> sentences_of(const Findings& f) {
  std::vector<std::string> words;
  const Stability& given = f.as_given();
  if (f.has_water) words.push_back(dry_sentence(f));
  words.push_back((f.has_water ? "With the water as given it " : "The slope ") +
                  held_text(given.mass));
  if (const auto& one = f.levels[f.given].as_one_body)
    words.push_back(
        "By limit equilibrium, as one body on its failure surface, it has a factor of " +
        text(*one, 3));
  if (std::isfinite(given.first.moves) && first_blocks(given).size() < given.of_block.size())
    words.push_back(first_sentence(given));
  if (f.seismic > 0)
    words.push_back("All this with an acceleration of " + text(f.seismic, 3) + " g down the slope");
  if (f.shaken) {
    words.push_back("After the given earthquake it " + held_text(f.shaken->mass));
    for (const ReducedRun& run : f.shaken->runs)
      if (run.factor == 1)
        words.push_back("The earthquake displaces it by " + text(run.displacement, 2) + " m");
  }
  if (f.n_samples > 0) words.push_back(drawn_sentence(f));
  return words;
}

Json json_of(const Findings& f) {
  Json levels = Json::array(), blocks = Json::array();
  for (std::size_t k = 0; k < f.levels.size(); ++k) {
    const AtLevel& level = f.levels[k];
    levels.push_back({{"water_higher_m", f.has_water ? Json(level.rise) : Json()},
                      {"water_m", f.has_water ? Json(measured(f, level.rise)) : Json()},
                      {"is_dry", !f.has_water || k == 0},
                      {"is_given", k == f.given},
                      {"mass", factor_json(level.found.mass)},
                      {"as_one_body", level.as_one_body ? number(*level.as_one_body) : Json()},
                      {"first", factor_json(level.found.first)}});
  }
  const Stability& given = f.as_given();
  for (const double factor : given.of_block) blocks.push_back(number(factor));
  const std::vector<int> first = first_blocks(given);
  return {{"words", sentences_of(f)},
          {"seismic_coefficient", f.seismic},
          {"water", f.has_water ? Json(text_of(f.measure)) : Json()},
          {"groups",
           {group_json(f, "mass", &Stability::mass, f.mass, static_cast<int>(blocks.size())),
            group_json(f, "blocks that go first", &Stability::first, f.first,
                       static_cast<int>(first.size()))}},
          {"levels", levels},
          {"first_blocks", first},
          {"factor_of_block", blocks}};
}

}  // namespace talus
