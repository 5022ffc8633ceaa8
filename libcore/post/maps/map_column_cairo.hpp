// libcore/post/maps/map_column_cairo.hpp
// What stands beside a map: legend, signs, scale, north, words.
#pragma once

#include "post/maps/map_page.hpp"
#include "post/maps/pen_cairo.hpp"

namespace talus {

/// How things are drawn on the map and in its legend.
inline constexpr double cell_opacity = 0.8;

[[nodiscard]] Stroke contour_stroke(bool is_numbered);
[[nodiscard]] Stroke source_stroke();
[[nodiscard]] Stroke line_stroke(bool stands);  ///< of a fence, or of a line that stops nothing
[[nodiscard]] Stroke object_stroke();
[[nodiscard]] Stroke hatch_stroke(const Colour& colour, double width = 0.28);
inline constexpr double class_hatch_mm = 1.2, class_hatch_width = 0.5, uncertain_hatch_mm = 1.4;

/// 1757200 as "1 757 200".
[[nodiscard]] std::string spaced(double value);

struct ColumnHeights {
  double legend = 0, foot = 0;  ///< [mm]
};
/// The legend from the upper side of `box` on, scale and words from `foot` on. [mm]
ColumnHeights draw_column(Pen& pen, const PageBox& box, double foot, const MapPage& page,
                          const MapGround& ground, const MapPlaces& places);

}  // namespace talus
