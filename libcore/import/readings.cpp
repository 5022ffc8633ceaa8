// Refusals that list each possible reading of an input, and how to choose it.
#include "import/readings.hpp"

#include <algorithm>
#include <cmath>

#include "base/length_units.hpp"
#include "base/text.hpp"
#include "terrain/elevation.hpp"

namespace talus {

Doubt choice_of(const Where& where, const std::string& finding,
                const std::vector<Reading>& readings) {
  Doubt doubt = doubt_on(where, finding);
  for (const Reading& reading : readings) {
    doubt.found +=
        (&reading == &readings.front() ? ": " : "; ") + reading.name + " " + reading.magnitude;
    doubt.hint += (doubt.hint.empty() ? "" : "; ") + reading.name + ": " + reading.way;
  }
  doubt.state = DoubtState::refused;
  return doubt;
}

Doubt choice_of_height_unit(const Where& where, double plan_unit_m, double low, double high,
                            double width, const std::string& way_to_plan,
                            const std::string& way_to_metres) {
  return choice_of(
      where,
      "the plan is in units of " + text(plan_unit_m, 10) +
          " m, and nothing says what unit the heights are in",
      {{"in that unit", rise_words(low * plan_unit_m, high * plan_unit_m, width), way_to_plan},
       {"in metres", rise_words(low, high, width), way_to_metres}});
}

std::vector<Reading> smaller_units(double low, double high, double width,
                                   const std::function<std::string(double)>& way) {
  struct Unit {
    const char* name;
    double metres;
  };
  std::vector<Reading> readings;
  for (const Unit& unit : {Unit{"as feet", foot_m}, Unit{"as decimetres", 0.1},
                           Unit{"as centimetres", 0.01}, Unit{"as millimetres", 0.001}})
    if (std::max(std::abs(low), std::abs(high)) * unit.metres <= highest_elevation)
      readings.push_back(
          {unit.name, rise_words(low * unit.metres, high * unit.metres, width), way(unit.metres)});
  return readings;
}

std::string length_words(double metres) {
  const double size = std::abs(metres);
  if (size >= 1000) return text(metres / 1000, 4) + " km";
  return size >= 0.1 || size == 0 ? text(metres, 4) + " m" : text(metres * 1000, 4) + " mm";
}

std::string rise_words(double low, double high, double width) {
  std::string words = "the heights go from " + text(low, 8) + " to " + text(high, 8) + " m";
  if (width > 0) words += ", " + length_words(high - low) + " over " + length_words(width);
  return words;
}

}  // namespace talus
