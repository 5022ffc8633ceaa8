// libcore/import/class_raster_gdal.hpp: public
// Rasters of classes (ground, land cover): whole numbers that are looked up, never interpolated.
// in:    any GDAL raster with one band of whole numbers, north-up, in the CRS of the terrain
// out:   the value under the centre of each cell of a TRN
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "site/ground_classes.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Value of the raster's pixel that holds the centre of each cell of `trn`, whatever the size of
/// the pixels; no_class outside of the raster and where it has no data.           (n_cells)
///
/// Throws InputError when the file is no raster, has not exactly one band, no place on the map, is
/// rotated, is in another CRS (classes are not reprojected silently), or holds a value that is not
/// a whole number.
[[nodiscard]] std::vector<std::int32_t> read_cell_classes(const std::string& path, const Trn& trn);

}  // namespace talus
