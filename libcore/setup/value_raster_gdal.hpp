// libcore/setup/value_raster_gdal.hpp: public
// Rasters of values that a section of the site file names, over a part of the terrain: properties
// of cells, not elevations.
#pragma once

#include <string>
#include <vector>

#include "base/input_log.hpp"
#include "setup/map_box.hpp"
#include "site/site.hpp"
#include "terrain/grid_frame.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A raster over the cells that a box meets.
struct ValueRaster {
  std::string key, path;      ///< "nrtrees_raster"
  GridFrame frame;            ///< of cell centres, map coordinates
  std::vector<double> value;  ///< NaN: unknown                                         (n_cells)

  [[nodiscard]] Vec2 centre_of(std::size_t cell) const;
  /// Throws InputError: the key, the finding, the place.
  [[noreturn]] void refuse(std::size_t cell, const std::string& finding,
                           const std::string& hint) const;
};

/// The key of a section that is read, in the system of the terrain.
struct ValueRasterContext {
  InputLog& log;
  const Site& site;
  const Trn& ground;
  std::string section;  ///< "forest.upper"
};

/// Throws InputError where the file is not a raster with one band, is in another system than the
/// terrain, or lies outside of the box.
[[nodiscard]] ValueRaster read_values(const ValueRasterContext& of, const char* key,
                                      const std::string& file, const MapBox& box);

/// Values of a raster at the nodes of the terrain, NaN where it is unknown; `role` is the key that
/// names `file`. Throws InputError where it is not a raster with one band or is in another system
/// than the terrain; where it `has_elevations`, in another system of heights, too.
[[nodiscard]] std::vector<double> read_at_nodes(InputLog& log, const Site& site, const Trn& ground,
                                                const std::string& role, const std::string& file,
                                                bool has_elevations);

/// Throws InputError, with the command that brings `raster` to them, where it has other cells than
/// `first`.
void check_same_cells(const ValueRaster& raster, const ValueRaster& first);

}  // namespace talus
