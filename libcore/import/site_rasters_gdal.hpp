// libcore/import/site_rasters_gdal.hpp: public
// Rasters that a site names: classes of ground, stands, failure surfaces. They are read where they
// are, in the system of the terrain: none is copied or reprojected.
// in:    any GDAL raster with one band, north-up
// out:   classes under the cells of a TRN; the content of a raster, for people
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/layer_reading.hpp"
#include "io/raster_commands.hpp"
#include "site/ground_classes.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Throws InputError, with the command that reprojects, where a raster and the terrain are in two
/// systems (WKT). One of them may be missing.
void check_raster_system(const std::string& raster, const std::string& terrain, CellKind kind,
                         const std::string& path);

/// Value of the raster's pixel that holds the centre of each cell of `trn`, whatever the size of
/// the pixels; no_class outside of the raster and where it has no data.           (n_cells)
///
/// Throws InputError when the file is not a raster, has not exactly one band, no place on the map,
/// is rotated, is in another CRS (check_raster_system), or holds a value that is not a whole
/// number.
[[nodiscard]] std::vector<std::int32_t> read_cell_classes(const std::string& path, const Trn& trn,
                                                          std::vector<Doubt>& doubts);

/// Content of a raster `role` ("dem", "forest.upper.nrtrees_raster"): its system, cells and unknown
/// value, and how large its values are. Of more than four million cells some rows are looked at.
/// Throws InputError as open_raster(), and where a row cannot be read.
[[nodiscard]] LayerReading look_at_raster(const std::string& role, const std::string& path);

}  // namespace talus
