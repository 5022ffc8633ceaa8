// libcore/io/raster_bands_gdal.hpp: public
// Opens a raster. One band counts: further ones are its mask, or one must be chosen.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "io/raster_commands.hpp"

class GDALDataset;

namespace talus {

/// Of a cell, at the far end of a raster: limit of skew, oblongness and offset from another
/// lattice.
inline constexpr double lattice_tolerance = 1e-3;

struct CloseDataset {
  void operator()(GDALDataset* dataset) const;
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// Throws InputError where the file is not a raster, is of a network, or holds several rasters
/// (subdatasets of a GeoPackage, netCDF or HDF5 file, pages of a TIFF), with GDAL's names for them.
[[nodiscard]] Dataset open_raster(const std::string& path);

/// The remedy for a grid of text that GDAL reads no further than a row that begins with a word
/// (nan, NA); for other rasters `otherwise`.
[[nodiscard]] std::string way_to_read(const std::string& path, const std::string& otherwise);

/// Throws InputError where the raster has no geotransform: with a remedy where it has ground
/// control points.
void check_placed(GDALDataset& dataset, const std::string& path, CellKind kind);

/// The geotransform of a raster whose rows run from west to east and from north to south. Throws
/// InputError, with the command that resamples, where they do not.
[[nodiscard]] std::array<double, 6> north_up_place(GDALDataset& dataset, const std::string& path,
                                                   CellKind kind);

/// Throws InputError unless there is one band, or one and an alpha band that is its mask.
void check_one_band(GDALDataset& dataset, const std::string& path);

/// A virtual raster (XML) of the first band whose mask is the second where that is alpha: cells
/// that are not opaque are unknown. GDAL itself takes alpha bands of bytes alone for masks, and
/// gdalwarp writes them in the type of the elevations. Empty where the second band is not alpha.
[[nodiscard]] std::string with_alpha_as_mask(GDALDataset& dataset);

}  // namespace talus
