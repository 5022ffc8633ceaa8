// libcore/io/foreign_hdf5.hpp
// HDF5 files of others (netCDF 4, BAG), before GDAL reads them.
#pragma once

#include <string>

namespace talus {

/// Name of the first object of the HDF5 file at `path` that is a link to another file, or whose
/// values stand in one; "" where there is none, or the file is no HDF5 file. Throws InputError
/// where it is one and cannot be opened.
[[nodiscard]] std::string kept_in_another_file(const std::string& path);

}  // namespace talus
