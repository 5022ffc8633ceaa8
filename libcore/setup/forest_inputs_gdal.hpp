// libcore/setup/forest_inputs_gdal.hpp
// The forests of [forest.*]: from polygons, rasters or lists to stems on the terrain, and from
// polygons to canopies that drag.
#pragma once

#include <string>
#include <vector>

#include "base/input_log.hpp"
#include "blocks/block_set.hpp"
#include "record/run_file.hpp"
#include "scene/canopy.hpp"
#include "scene/forest.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Forests of a run.
struct StandingForests {
  std::vector<Stem> stems;          ///< Stem::section: index into `forests`
  std::vector<GroundClass> faces;   ///< of each of them
  std::vector<ForestInfo> forests;  ///< that have stems
  std::vector<Canopy> canopies;
  std::vector<std::string> warnings;  ///< that were given: the parts left out
};

/// The stems and canopies of the active [forest.*]; none with law paper. Stems of a list off the
/// known ground are left out with a warning, and so are stems of a drawn stand in a block at its
/// start. Throws InputError for a forest that does not give its place or gives it twice, that
/// lacks a stem on the terrain, that has stems and drags, with keys or rasters that do not go
/// together, with more than 1e6 stems, stems without a diameter, of an unknown species, and a
/// listed stem in a block or at the place of one of a section before. Warns of stands of one
/// kind that share ground.
[[nodiscard]] StandingForests read_forests(InputLog& log, const Site& site, const Trn& trn,
                                           const BlockSet& blocks);

}  // namespace talus
