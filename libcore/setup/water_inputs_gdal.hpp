// libcore/setup/water_inputs_gdal.hpp: public
// [water] of a site file: how high water is in the joints of its blocks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/input_log.hpp"
#include "blocks/block_set.hpp"
#include "scene/joint_water.hpp"
#include "site/site.hpp"

namespace talus {

/// None without [water]. Throws InputError where it says nothing, or two things, of how high water
/// is, names a joint set that is not among `sets`, or where blocks fall one by one.
[[nodiscard]] std::optional<JointWater> joint_water(InputLog& log, const Site& site,
                                                    const Trn& ground,
                                                    const std::vector<std::string>& sets);

/// Where a raster of the water is unknown there is none. For a part of the mass that is a doubt,
/// for all of it an InputError.
void check_water_cover(InputLog& log, const Site& site, const Trn& ground, const JointWater& water,
                       const BlockSet& blocks);

}  // namespace talus
