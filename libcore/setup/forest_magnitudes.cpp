// Magnitudes of a forest's stems, which show a mistaken unit: forest_section.hpp.
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/percentile.hpp"
#include "base/text.hpp"
#include "setup/forest_section.hpp"

namespace talus {
namespace {

struct Spread {
  double low = 0, median = 0, high = 0;
};

// Of some values, one at least.
Spread spread_of(const std::vector<double>& values) {
  std::vector<WeightedValue> sorted;
  for (const double value : values) sorted.push_back({value, 1});
  sort_values(sorted);
  return {sorted.front().value, weighted_percentile(sorted, 0.5), sorted.back().value};
}

// Three digits, and all before the point.
std::string words_of(double value) {
  return value >= 100 ? text(std::round(value)) : text(value, 3);
}

// "35 (22 to 48)", or "35" where all are alike.
std::string words_of(const Spread& spread) {
  const std::string range = words_of(spread.low) + " to " + words_of(spread.high);
  return words_of(spread.median) + (spread.low == spread.high ? "" : " (" + range + ")");
}

// The unit in which a median of implausible centimetres would be a stem.
std::string in_another_unit(double median_cm) {
  constexpr std::array<std::pair<const char*, double>, 4> units = {
      {{"metres", 100}, {"millimetres", 0.1}, {"inches", 2.54}, {"feet", 30.48}}};
  for (const auto& [name, cm] : units)
    if (median_cm * cm >= 8 && median_cm * cm <= 80)
      return std::string("; read as ") + name + " it would be " + text(median_cm * cm, 3) + " cm";
  return {};
}

std::string said_by(const ForestSection& s) {
  const ForestSettings& f = s.forest;
  return !f.stems_file.empty()      ? "dbh_cm of " + f.stems_file
         : f.dbhmean_raster.empty() ? "dbh_mean_cm"
                                    : "dbhmean_raster " + f.dbhmean_raster;
}

// The median alone is judged: single stems may be of any size.
void check_diameters(const ForestSection& s, const Spread& cm) {
  constexpr double thinnest = 1, thin = 4, thick = 120, thickest = 300;  // cm
  if (cm.median >= thin && cm.median <= thick) return;
  const std::string finding = "half of the stems are " +
                              std::string(cm.median < thin ? "thinner" : "thicker") + " than " +
                              words_of(cm.median) + " cm (" + words_of(cm.low) + " to " +
                              words_of(cm.high) + ")" + in_another_unit(cm.median);
  if (cm.median < thinnest || cm.median > thickest)
    s.refuse(finding + ": that is not a forest",
             said_by(s) + " holds diameters at breast height in centimetres: bring them to these");
  s.warn(finding + ": is " + said_by(s) + " in centimetres?");
}

}  // namespace

void say_stems(const ForestSection& s, const std::vector<Stem>& stems) {
  const std::string number = counted(static_cast<std::int64_t>(stems.size()), "stem");
  if (stems.empty()) return s.log.info(s.name() + ": " + number);
  constexpr double highest = 130;  // the highest tree that is known has 116 m
  if (s.forest.height_m > highest)
    s.refuse("has trees of " + text(s.forest.height_m) + " m, expected up to " + text(highest),
             "height_m is in metres");
  std::vector<double> diameters;
  for (const Stem& stem : stems) diameters.push_back(200 * stem.radius);
  const Spread cm = spread_of(diameters);
  s.log.info(s.name() + ": " + number + ", diameter " + words_of(cm) + " cm, height " +
             text(s.forest.height_m) + " m");
  check_diameters(s, cm);
}

void say_stocking(const ForestSection& s, const std::vector<StockedCell>& cells) {
  if (cells.empty()) return;
  std::vector<double> stems, percent;
  for (const StockedCell& cell : cells) {
    stems.push_back(cell.stocking.stems_per_ha);
    percent.push_back(100 * cell.stocking.conifer_share);
  }
  const Spread per_ha = spread_of(stems), conifers = spread_of(percent);
  s.log.info(s.name() + ": " + words_of(per_ha) + " stems a hectare, conifers " +
             words_of(conifers) + " %");
  if (!s.forest.conif_percent_raster.empty() && conifers.high > 0 && conifers.high <= 1)
    s.refuse("has a conif_percent_raster of " + words_of(conifers) + " %, in no cell more than 1 %",
             "it holds per cent, 0 to 100: are these shares, 0 to 1? Multiply them by 100; for a "
             "wood without conifers take the raster out and set conifer_share = 0");
  constexpr double few = 30, usual = 100;
  const double as_cells = per_ha.median * 1e4 / (cells[0].cell.size * cells[0].cell.size);
  if (!s.forest.nrtrees_raster.empty() && per_ha.median < few && as_cells >= usual)
    s.warn("nrtrees_raster has " + words_of(per_ha) +
           " stems a hectare: are they stems a cell? Then there are " + words_of(as_cells) +
           " a hectare, and the values are to be multiplied by " +
           text(as_cells / per_ha.median, 6));
}

}  // namespace talus
