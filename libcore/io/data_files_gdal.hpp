// libcore/io/data_files_gdal.hpp: public
// Which files a data set is made of: a change of any of them is a change of the data set.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// The file itself, and the files that GDAL reads with it: CRS and world files, the parts of a
/// Shapefile, a journal of SQLite that still holds changes; all files of a folder; the sources of a
/// virtual raster with their own. By name. Not among them: overviews, indices, and a side file that
/// holds statistics alone, which programs write that only look. Of a file that GDAL cannot read, or
/// that is missing: itself.
[[nodiscard]] std::vector<std::string> data_files(const std::string& path);

/// SHA-256 of all of these; empty where the source is not a file (/vsi..., a database).
[[nodiscard]] std::string digest_of_data(const std::string& source);

}  // namespace talus
