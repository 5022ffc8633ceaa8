// libcore/io/tags_gdal.hpp: public
// What a raster or GeoPackage says of itself: the tags that the tools write, e.g. RUN_ID.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// The tag `name` of the file; "" when it has none or cannot be read.
[[nodiscard]] std::string tag_of(const std::string& path, const std::string& name);

struct BandTags {
  std::string name, unit;
  std::string meaning;  ///< what a value of it is
};
/// Of each band of a raster that map_raster_gdal.hpp wrote; none when it cannot be read.
[[nodiscard]] std::vector<BandTags> band_tags(const std::string& path);

}  // namespace talus
