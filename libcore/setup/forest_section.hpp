// libcore/setup/forest_section.hpp
// A section [forest.*] while it is read, and its rasters. Shared by setup/forest_*.cpp.
#pragma once

#include <string>
#include <vector>

#include "base/input_log.hpp"
#include "scene/forest.hpp"
#include "scene/stand.hpp"
#include "setup/map_box.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

struct ForestSection {
  InputLog& log;
  const Site& site;
  const Trn& trn;
  const ForestSettings& forest;
  std::vector<std::string>& warnings;  ///< for the run file

  [[nodiscard]] std::string name() const { return "forest." + forest.name; }
  [[nodiscard]] Where where() const { return {site.file, forest.line, name()}; }
  [[nodiscard]] bool is_given(const char* key) const {
    return site.sources.count(name() + "." + key) > 0;
  }
  [[noreturn]] void refuse(const std::string& finding, const std::string& hint) const {
    throw InputError(where(), finding, hint);
  }
  void warn(const std::string& finding) const {
    warnings.push_back(name() + ": " + finding);
    log.warn(warnings.back());
  }
  void refuse_both(const char* key, const char* other) const {
    if (is_given(key) && is_given(other))
      refuse(std::string("has both ") + key + " and " + other,
             "say it once: leave one of them out");
  }
};

/// A cell and the trees on it.
struct StockedCell {
  StandCell cell;
  Stocking stocking;
};

/// The cells of nrtrees_raster that `box` meets and that hold trees; values without a raster are
/// those of the section's keys. Throws InputError for rasters of other cells or another CRS,
/// beside the box, and for values that no trees have.
[[nodiscard]] std::vector<StockedCell> cells_of_rasters(const ForestSection& section,
                                                        const MapBox& box);

/// Says how many stems there are, how thick and how high. Warns where half of them are thinner than
/// 4 cm or thicker than 120 cm; throws InputError where half are thinner than 1 cm or thicker than
/// 300 cm, and for trees higher than 130 m.
void say_stems(const ForestSection& section, const std::vector<Stem>& stems);

/// Says how many stems a hectare the cells have and how many conifers. Warns of so few that they
/// may be stems a cell; throws InputError for a raster of per cent with shares.
void say_stocking(const ForestSection& section, const std::vector<StockedCell>& cells);

}  // namespace talus
