// libcore/post/maps/map_drawing.hpp: public
// A map by the pen, part by part: the ground, cells and places on pages and in reports
// look the same.
#pragma once

#include "draw/drawing.hpp"
#include "post/maps/map_page.hpp"

namespace talus {

/// Where a map is drawn.
struct MapSpot {
  PageBox frame;  ///< [mm]
  MapView view;
  double letters = 1;     ///< size of the letters, 1 on paper
  bool is_whole = false;  ///< nothing is beside the frame: coordinates are inside
};
[[nodiscard]] Vec2 on_map(const MapSpot& spot, const Vec2& local);
[[nodiscard]] std::vector<Vec2> on_map(const MapSpot& spot, const std::vector<Vec2>& local);

void draw_shading(Pen& pen, const MapSpot& spot, const MapGround& ground);
void draw_cells(Pen& pen, const MapSpot& spot, const MapCells& cells);
void draw_contours(Pen& pen, const MapSpot& spot, const MapGround& ground);
/// With a note of the name at each object and line.
void draw_places(Pen& pen, const MapSpot& spot, const MapPlaces& places);
/// A name beside a point of the drawing, where the frame shows it.
void draw_name(Pen& pen, const MapSpot& spot, const Vec2& beside, const std::string& name,
               const Colour& colour);
/// Lines of round coordinates; `origin`: map coordinates of the local zero [m].
void draw_grid(Pen& pen, const MapSpot& spot, const Vec2& origin);

/// The tip of an arrow to the north is at `tip`.
void draw_north(Pen& pen, const Vec2& tip, double letters = 1);
/// The bar's left end is at `at`.
void draw_scale_bar(Pen& pen, const Vec2& at, const MapView& view, double letters = 1);

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

/// A page with its title, legend, scale and words.
[[nodiscard]] Drawing page_drawing(const MapPage& page, const MapGround& ground,
                                   const MapPlaces& places);

}  // namespace talus
