// libcore/io/data_files_gdal.hpp: public
// Which files a data set is made of, with those of the data sets among them.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// As dataset_files() of io/dataset_files_gdal.hpp, the files of the data sets among them (the
/// sources of a virtual raster that another one names, the header beside a source) and those of
/// sidecars_of() that are there, which GDAL does not name: the encoding of a Shapefile. By name.
[[nodiscard]] std::vector<std::string> data_files(const std::string& path);

/// SHA-256 of all of these; empty where the source is no file (/vsi..., a database).
[[nodiscard]] std::string digest_of_data(const std::string& source);

}  // namespace talus
