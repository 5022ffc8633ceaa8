// libcore/io/data_files_gdal.hpp: public
// Which files a data set is made of, with those of the data sets among them.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// As dataset_files() of io/dataset_files_gdal.hpp, and the files of the data sets among them: the
/// sources of a virtual raster that another one names, the header beside a source. By name.
[[nodiscard]] std::vector<std::string> data_files(const std::string& path);

}  // namespace talus
