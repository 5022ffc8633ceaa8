// tools/frame/map_output.hpp
// Layers of cells as every tool writes them: raster, style and picture beside each other.
// in:    layers over the cells of one grid, the terrain below
// out:   NAME.tif (COG), NAME.qml, NAME.png
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/map_raster_gdal.hpp"
#include "post/maps/map_picture.hpp"
#include "post/maps/maps.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

using MapTags = std::vector<std::pair<std::string, std::string>>;

/// Rows and columns of a grid, the last ones excluded.
struct CellWindow {
  int row_begin = 0, row_end = 0, col_begin = 0, col_end = 0;
};

/// What all maps of one grid share.
struct MapFrame {
  Vec2 corner = Vec2::Zero();  ///< north-west, map coordinates [m]
  PassageGrid grid;
  std::string crs_wkt;
  std::vector<bool> known;  ///< ground below the cell                              (n_cells)
  bool png = false;
  CellWindow drawn;  ///< of the pictures
  Shading shading;   ///< of that; empty without `png`
};
/// The pictures' part of the grid that a map of the same cells says (tag PICTURE_CELLS), so that
/// pictures of several sets of runs stand side by side. Throws InputError for a map without
/// pictures or of other cells.
[[nodiscard]] CellWindow window_of_map(const std::string& path, const PassageGrid& grid,
                                       const Where& where);

/// Pictures show `window`, or without it the cells `touched` and half as much again on each side,
/// ten cells at least, since on a large terrain a slide is a dot; all of the grid when there are
/// none.
[[nodiscard]] MapFrame map_frame(const Trn& trn, const PassageGrid& grid, bool png,
                                 const std::vector<std::uint32_t>& touched,
                                 const std::optional<CellWindow>& window = {});

/// Stages `path` (NAME.tif) and its sidecars. Cells without known ground that nothing touched hold
/// nodata. Adds the tags SHOWN_BAND and, with pictures, PICTURE_CELLS. Returns the band that the
/// style shows. Throws InputError. `certain`: where its first band is 0 the picture is hatched;
/// null: nowhere.
std::string write_map(Tool& tool, const MapFrame& frame, const std::string& path,
                      const MapLayer& layer, const RasterStyle& style, MapTags tags,
                      const std::vector<std::string>& creation_options = {},
                      const MapLayer* certain = nullptr);

}  // namespace talus
