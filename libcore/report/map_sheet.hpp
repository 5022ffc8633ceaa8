// libcore/report/map_sheet.hpp
// The maps of a report: each draws its cells between a ground and places that are drawn once.
// in:    the ground of a page (post/maps/map_page.hpp), source, fences, objects; cells as pictures
// out:   SVG in metres, x to the east, y to the south, zero at the north-west corner of the view
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "post/maps/map_page.hpp"
#include "report/texts.hpp"

namespace talus {

struct MapSheet {
  MapGround ground;
  std::string shading_png;                ///< of ground.shading
  std::vector<std::vector<Vec2>> source;  ///< rings, local [m]
  std::vector<RecordLine> lines;
  std::vector<RecordObject> objects;
  Vec2 origin = Vec2::Zero();  ///< map coordinates of the local zero [m]
};

/// The cells of a map that the view shows.
struct CellPicture {
  std::string png;             ///< a pixel a cell, in the colours of the legend; empty: no map
  Vec2 corner = Vec2::Zero();  ///< north-west, local [m]
  double cell_size = 1;        ///< [m]
  int n_rows = 0, n_cols = 0;
  std::string values;  ///< floats from north to south, by zlib; empty: not shown
  std::vector<std::pair<int, std::string>> labels;  ///< of codes; empty: values are numbers
  std::vector<bool> weak, unsure;  ///< cells hatched in white, in black; empty: none
};

/// What all maps use: an SVG that is not seen itself.
[[nodiscard]] std::string sheet_definitions(const Texts& texts, const MapSheet& sheet);

/// Ground, `between`, places, marks.
[[nodiscard]] std::string sheet_svg(const MapSheet& sheet, const std::string& between,
                                    const std::string& alt);
/// The cells by themselves, with their hatches: to stand between.
[[nodiscard]] std::string cells_image(const MapSheet& sheet, const CellPicture& cells);
/// A map of cells, with the value at the cursor where the page's script runs.
[[nodiscard]] std::string cells_svg(const MapSheet& sheet, const CellPicture& cells,
                                    const std::string& alt, const std::string& unit);

/// A point of the drawing.
[[nodiscard]] inline Vec2 on_sheet(const MapSheet& sheet, const Vec2& local) {
  return {local.x() - sheet.ground.view.low.x(), sheet.ground.view.high.y() - local.y()};
}
/// The path of a line in SVG, to the centimetre.
[[nodiscard]] std::string sheet_path(const MapSheet& sheet, const std::vector<Vec2>& points,
                                     bool is_closed);

}  // namespace talus
