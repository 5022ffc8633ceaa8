// tools/frame/map_output.hpp
// Layers of cells as every tool writes them: raster, style and pages beside each other.
// in:    layers over the cells of one grid, the terrain below
// out:   NAME.tif (COG), NAME.qml, NAME.png, NAME.pdf
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/map_raster_gdal.hpp"
#include "post/maps/map_page.hpp"
#include "post/maps/maps.hpp"
#include "tools/frame/run_inputs.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

using MapTags = std::vector<std::pair<std::string, std::string>>;

/// Which pages are drawn: "png,pdf,a3"; empty: none.
struct PageOptions {
  std::string words;
  [[nodiscard]] bool has(const std::string& word) const {
    return ("," + words + ",").find("," + word + ",") != std::string::npos;
  }
};
/// Declares --pages on a tool.
void add_pages_option(Tool& tool, PageOptions& pages);

/// Rows and columns of a grid, the last ones excluded.
struct CellWindow {
  int row_begin = 0, row_end = 0, col_begin = 0, col_end = 0;
};

/// Common part of all maps of one grid.
struct MapFrame {
  Vec2 corner = Vec2::Zero();  ///< north-west, map coordinates [m]
  PassageGrid grid;
  std::string crs_wkt;
  std::vector<bool> known;  ///< ground below the cell                              (n_cells)
  PageOptions pages;
  CellWindow drawn;  ///< cells that pages show at least
  // of pages; empty without them
  MapGround ground;
  MapPlaces places;
  std::string law;  ///< of the runs
};
/// The cells that the pages of a map of the same cells show at least (tag PICTURE_CELLS), so that
/// pages of several sets of runs can be compared side by side. Throws InputError for a map without
/// pages or of other cells.
[[nodiscard]] CellWindow window_of_map(const std::string& path, const PassageGrid& grid,
                                       const Where& where);

/// Pages show `window`, or without it the cells `touched` and a quarter as much again on each side,
/// five cells at least, since on a large terrain a slide is a dot; all of the grid when there are
/// none. Throws InputError when pages are wanted and their font is not there.
[[nodiscard]] MapFrame map_frame(RunInputs& runs, const PassageGrid& grid, const PageOptions& pages,
                                 const std::vector<std::uint32_t>& touched,
                                 const std::optional<CellWindow>& window = {});

/// Stages `path` (NAME.tif) and the files beside it. Cells without known ground that nothing
/// touched hold nodata. Adds the tags SHOWN_BAND and, with pages, PICTURE_CELLS. Returns the band
/// that the style shows. Throws InputError. `certain`: where its first band is 0 pages are hatched;
/// null: nowhere.
std::string write_map(Tool& tool, const MapFrame& frame, const std::string& path,
                      const MapLayer& layer, const RasterStyle& style, MapTags tags,
                      const MapLayer* certain = nullptr);

}  // namespace talus
