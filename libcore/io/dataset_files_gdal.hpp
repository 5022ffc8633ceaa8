// libcore/io/dataset_files_gdal.hpp
// Which files a data set is made of: a change of any of them is a change of the data set.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// The file itself, and what GDAL reads with it: CRS and world files, the parts of a Shapefile, the
/// sources of a virtual raster, a journal of SQLite that still holds changes; all files of a
/// folder. By name. Not among them: overviews, indices, and a side file that holds statistics
/// alone, which programs write that only look. Of a file that GDAL cannot read, or that is missing:
/// itself.
[[nodiscard]] std::vector<std::string> dataset_files(const std::string& path);

}  // namespace talus
