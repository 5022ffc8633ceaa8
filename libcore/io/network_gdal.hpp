// libcore/io/network_gdal.hpp: public
// Foreign files must not make GDAL contact other machines, or read files that nobody named.
// in:    network_is_allowed() (base/network.hpp)
#pragma once

#include <string>

class GDALDataset;

namespace talus {

/// Once drivers are registered: only those stay whose files hold their own values or have them
/// beside them. File systems and downloads over a network are refused, virtual rasters run no
/// Python.
void forbid_network();

/// Throws InputError where a virtual raster, or one that it names, is on a network or takes the raw
/// bytes of a file.
void check_virtual(const std::string& path);

/// Throws InputError where a data base (SQLite, GeoPackage) has virtual tables that read files.
void check_tables(GDALDataset& database, const std::string& path);

/// The remedy where no driver opens a file as raster, or as vectors: for a format that
/// forbid_network() takes out, for a file of the other kind, else `otherwise`.
[[nodiscard]] std::string way_to_open(const std::string& path, bool as_raster,
                                      const std::string& otherwise);

}  // namespace talus
