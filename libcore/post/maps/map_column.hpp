// libcore/post/maps/map_column.hpp
// The column beside a map: legend, signs, scale, north, words.
#pragma once

#include "post/maps/map_drawing.hpp"

namespace talus {

struct ColumnHeights {
  double legend = 0, foot = 0;  ///< [mm]
};
/// The legend from the upper side of `box` on, scale and words from `foot` on. [mm]
ColumnHeights draw_column(Pen& pen, const PageBox& box, double foot, const MapPage& page,
                          const MapGround& ground, const MapPlaces& places);

}  // namespace talus
