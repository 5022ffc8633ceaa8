// libcore/io/archives_gdal.hpp: public
// Archives (zip, tar) as they are downloaded, with one file of data.
#pragma once

#include <string>
#include <vector>

#include "base/source_path.hpp"

namespace talus {

enum class Contents { vectors, rasters };

/// The source that GDAL opens for a path: the one file of data where the path is an archive, else
/// its own. Throws InputError where there is none, or several; Shapefiles of one folder are one.
/// `remarks` gets a sentence on the member taken.
[[nodiscard]] std::string source_in(const SourcePath& path, Contents contents,
                                    std::vector<std::string>& remarks);

/// The remedy where several rasters are given for one: `command` makes one of tiles. Where two lie
/// over one another they are not tiles, and one is to be named. `rasters`: as GDAL names them;
/// `names`: as the user would.
[[nodiscard]] std::string way_to_one_raster(const std::vector<std::string>& rasters,
                                            const std::vector<std::string>& names,
                                            const std::string& command);

}  // namespace talus
