// libcore/report/map_sheet.hpp
// The maps of a report: each draws its cells between a ground and places that are drawn once.
// in:    the ground of a page (post/maps/map_page.hpp), source, fences, objects; cells
// out:   SVG of the frame of an A4 page
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "post/maps/map_drawing.hpp"
#include "report/texts.hpp"

namespace talus {

struct MapSheet {
  MapGround ground;
  MapPlaces places;            ///< of the source the rim
  Vec2 origin = Vec2::Zero();  ///< map coordinates of the local zero [m]
};

/// The cells of a map that the view shows.
struct CellPicture {
  MapCells cells;      ///< no rows: no map
  std::string values;  ///< floats from north to south, by zlib; empty: not shown
  std::vector<std::pair<int, std::string>> labels = {};  ///< of codes; empty: values are numbers
};

/// Definitions for all maps: an SVG that is not visible.
[[nodiscard]] std::string sheet_definitions(const Texts& texts, const MapSheet& sheet);

/// Strokes on the sheet, to be between ground and places.
[[nodiscard]] std::string sheet_group(const MapSheet& sheet, const std::string& css_class,
                                      const std::function<void(Pen&, const MapSpot&)>& draw);
/// Ground, `between`, places, marks.
[[nodiscard]] std::string sheet_svg(const MapSheet& sheet, const std::string& between,
                                    const std::string& alt);
/// The cells alone, with their hatches: to be put between other groups.
[[nodiscard]] std::string cells_group(const MapSheet& sheet, const MapCells& cells);
/// A map of cells, with the value at the cursor where the page's script runs.
[[nodiscard]] std::string cells_svg(const MapSheet& sheet, const CellPicture& picture,
                                    const std::string& alt, const std::string& unit);

}  // namespace talus
