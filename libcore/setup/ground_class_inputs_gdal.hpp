// libcore/setup/ground_class_inputs_gdal.hpp
// Which class of ground, a section [ground.*], each cell of the terrain has: from polygons and
// rasters that the site file names.
#pragma once

#include <cstdint>
#include <vector>

#include "base/input_log.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Index of the section for each cell; empty where there is one section and no raster. Polygons win
/// over the raster. Throws InputError for ground without a class, values of the raster that no
/// section names or that two do, and more than 255 sections.
[[nodiscard]] std::vector<std::uint8_t> ground_classes(InputLog& log, const Site& site,
                                                       const Trn& trn);

}  // namespace talus
