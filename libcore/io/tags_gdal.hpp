// libcore/io/tags_gdal.hpp: public
// Tags that the tools write into rasters and GeoPackages, e.g. RUN_ID.
#pragma once

#include <string>
#include <vector>

namespace talus {

/// The tag `name` of the file; "" when it has none or cannot be read.
[[nodiscard]] std::string tag_of(const std::string& path, const std::string& name);

struct BandTags {
  std::string name, unit;
  std::string meaning;  ///< meaning of its values
};
struct RasterTags {
  std::string shown;  ///< tag SHOWN_BAND: the name of a band
  std::vector<BandTags> bands;
};
/// Of a raster that map_raster_gdal.hpp wrote; nothing when it cannot be read.
[[nodiscard]] RasterTags raster_tags(const std::string& path);

}  // namespace talus
