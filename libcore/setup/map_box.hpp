// libcore/setup/map_box.hpp: public
// A part of the map that is asked for.
#pragma once

#include <limits>

#include "base/types.hpp"
#include "terrain/grid_frame.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// A box in map coordinates.
struct MapBox {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity());
  Vec2 high = Vec2::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec2& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  [[nodiscard]] bool is_empty() const { return (low.array() >= high.array()).any(); }
};

/// The nodes of a terrain.
[[nodiscard]] inline MapBox box_of_terrain(const Trn& trn) {
  const MapWindow window = extent(frame_of(trn));
  MapBox box;
  box.add(Vec2(window.x_min, window.y_min));
  box.add(Vec2(window.x_max, window.y_max));
  return box;
}

}  // namespace talus
