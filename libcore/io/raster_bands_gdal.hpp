// libcore/io/raster_bands_gdal.hpp
// A raster has one band that counts: what else a file may hold is its mask, or must be chosen.
#pragma once

#include <string>

class GDALDataset;

namespace talus {

/// Throws InputError, with GDAL's names for them, when the file holds several rasters: subdatasets
/// of a GeoPackage, netCDF or HDF5 file, pages of a TIFF.
void refuse_several_rasters(GDALDataset& dataset, const std::string& path);

/// Throws InputError unless there is one band, or one and an alpha band that is its mask.
void check_one_band(GDALDataset& dataset, const std::string& path);

}  // namespace talus
