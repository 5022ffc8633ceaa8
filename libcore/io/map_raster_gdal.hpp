// libcore/io/map_raster_gdal.hpp: public
// Results as rasters: cloud-optimised GeoTIFF with named and described bands.
// in:    bands of cells from north to south, west to east, one after the other
// out:   COG (deflate, overviews without averaging)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/types.hpp"
#include "io/overview.hpp"

namespace talus {

struct MapRasterBand {
  std::string name;       ///< the band's description
  std::string unit;       ///< "kJ", "m", "m/s", "deg", "1", ...
  std::string long_name;  ///< definition, one sentence
  OverviewValue overview = OverviewValue::largest;
};

struct MapRaster {
  static constexpr float nodata = -9999;
  static constexpr float nodata_of_codes = 255;
  Vec2 corner = Vec2::Zero();  ///< map coordinates of the north-west corner [m]
  double cell_size = 0;        ///< [m]
  int n_rows = 0, n_cols = 0;
  std::string crs_wkt;
  std::vector<MapRasterBand> bands;
  /// The cells of a band, n_rows x n_cols, `nodata_value()` where there is none; asked for band
  /// after band, so that memory holds one.
  std::function<std::vector<float>(std::size_t band)> values;
  std::vector<std::pair<std::string, std::string>> tags;  ///< of the whole file, e.g. RUN_ID
  /// Bands are bytes that are codes, 255: nodata, not floats.
  bool is_codes = false;
  std::vector<std::pair<int, std::array<std::uint8_t, 4>>> colours = {};  ///< of codes, of band 1
  [[nodiscard]] float nodata_value() const { return is_codes ? nodata_of_codes : nodata; }
};

/// Writes a COG, byte by byte the same for the same raster and options. Overviews take one
/// of the values below, so that a fast block is not averaged away when zooming out.
/// Throws InputError when it cannot be written whole.
void write_map_raster(const std::string& path, const MapRaster& raster);

}  // namespace talus
