// libcore/io/raster_bands_gdal.hpp
// Opens a raster. One band counts: what else a file may hold is its mask, or must be chosen.
#pragma once

#include <memory>
#include <string>

class GDALDataset;

namespace talus {

struct CloseDataset {
  void operator()(GDALDataset* dataset) const;
};
using Dataset = std::unique_ptr<GDALDataset, CloseDataset>;

/// Throws InputError where the file is no raster, is of a network, or holds several rasters
/// (subdatasets of a GeoPackage, netCDF or HDF5 file, pages of a TIFF), with GDAL's names for them.
[[nodiscard]] Dataset open_raster(const std::string& path);

/// Throws InputError unless there is one band, or one and an alpha band that is its mask.
void check_one_band(GDALDataset& dataset, const std::string& path);

/// A virtual raster (XML) of the first band whose mask is the second where that is alpha: cells
/// that are not opaque are unknown. GDAL itself takes alpha bands of bytes alone for masks, and
/// gdalwarp writes them in the type of the elevations. Empty where the second band is no alpha.
[[nodiscard]] std::string with_alpha_as_mask(GDALDataset& dataset);

}  // namespace talus
