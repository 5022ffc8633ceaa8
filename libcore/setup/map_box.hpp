// libcore/setup/map_box.hpp: public
// A part of the map that is asked for.
#pragma once

#include <limits>

#include "base/types.hpp"

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

}  // namespace talus
