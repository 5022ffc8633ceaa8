// libcore/post/maps/map_page.hpp: public
// A map as a page: its content and its scale.
// in:    values of cells, their style, the terrain, source, fences and objects
// out:   numbers of the page; map_drawing.hpp draws it
#pragma once

#include <string>
#include <vector>

#include "draw/pen.hpp"
#include "draw/ticks.hpp"
#include "io/level_lines.hpp"
#include "io/style.hpp"
#include "post/maps/map_places.hpp"
#include "post/maps/shading.hpp"

namespace talus {

/// Landscape.
enum class PageSize { a4, a3 };

/// Positions of the parts of a page [mm].
struct PageLayout {
  double width = 0, height = 0;
  PageBox map;     ///< the frame of the map
  PageBox column;  ///< legend, scale, words
};
[[nodiscard]] PageLayout layout_of(PageSize size);

/// The part of the ground in the frame.
struct MapView {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< local [m]
  double scale = 1;                              ///< 1 : scale, a round number
};
/// The middle of the rectangle from `low` to `high` at the largest round scale that shows all of
/// it.
[[nodiscard]] MapView view_of(const PageLayout& layout, const Vec2& low, const Vec2& high);

/// Between the lines of the coordinate grid: 25 mm of the page or more [m].
[[nodiscard]] inline double grid_spacing(const MapView& view) {
  return round_up(0.025 * view.scale);
}
/// Of the scale bar: 50 mm of the page or less [m].
[[nodiscard]] inline double bar_length(const MapView& view) {
  return round_down(0.050 * view.scale);
}

/// The ground in the frame, the same for all maps of one view.
struct MapGround {
  MapView view;
  Shading shading;                  ///< from the north-west corner of the view
  double shading_cell = 1;          ///< [m]
  double contour_interval = 0;      ///< every fifth line is numbered; 0: no lines [m]
  std::vector<LevelLine> contours;  ///< local; level is the height above the datum [m]
};
[[nodiscard]] MapGround map_ground(const Trn& trn, const PageLayout& layout, const MapView& view);

/// Every fifth line has its height written.
[[nodiscard]] bool is_numbered(const MapGround& ground, const LevelLine& line);
/// Position of a height: in the middle of `at`, along its line.
struct LevelLabel {
  double level = 0;        ///< [m]
  Vec2 at = Vec2::Zero();  ///< from the upper left corner of the frame [mm]
  double angle = 0;        ///< anticlockwise from the east, upright [rad]
};
/// Heights where their lines are straight and no other height is near, in a frame of `size` [mm].
[[nodiscard]] std::vector<LevelLabel> level_labels(const MapGround& ground, const Vec2& size);

/// Cells in the colours of their classes.
struct MapCells {
  PassageGrid grid;
  std::vector<float> value;     ///< of the band that the style shows             (n_cells)
  float nodata = 0;             ///< cells that are not drawn
  std::vector<bool> uncertain;  ///< cells that are hatched; empty: none          (n_cells)
  RasterStyle style;            ///< its legend, classes, remark and notes
};

struct MapPage {
  PageSize size = PageSize::a4;
  std::string title, subtitle;     ///< the quantity; the site and runs
  std::string crs;                 ///< name of the coordinate system
  std::vector<std::string> words;  ///< paragraphs below the legend: runs, model, limits
  MapCells cells;
  Vec2 origin = Vec2::Zero();  ///< map coordinates of the local zero [m]
};

}  // namespace talus
