// libcore/io/tags_gdal.hpp: public
// What a raster or GeoPackage says of itself: the tags that the tools write, e.g. RUN_ID.
#pragma once

#include <string>

namespace talus {

/// The tag `name` of the file; "" when it has none or cannot be read.
[[nodiscard]] std::string tag_of(const std::string& path, const std::string& name);

}  // namespace talus
