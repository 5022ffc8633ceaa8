// libcore/blocks/prepared_area.hpp: public
// An area that is asked for many points.
#pragma once

#include <cstddef>
#include <vector>

#include "blocks/area.hpp"

namespace talus {

/// Gives for points the result of contains(area, point). The sides that matter at the height of a
/// point are known beforehand.
class PreparedArea {
 public:
  explicit PreparedArea(const Area& area);
  [[nodiscard]] bool contains(const Vec2& point) const;
  /// Adds where the straight segment from one point to another may cross the border, as shares of
  /// it; all crossings are among them, perhaps repeatedly.
  void add_crossings(const Vec2& from, const Vec2& to, std::vector<double>& shares) const;
  /// Sides that contains() looks at for a point.
  [[nodiscard]] std::size_t n_looked_at(const Vec2& point) const;

 private:
  struct Side {
    Vec2 a, b;
  };
  [[nodiscard]] std::size_t band_of(double y) const;
  double low_ = 0, high_ = 0, per_height_ = 0;
  std::vector<std::vector<Side>> bands_;  // from low_ to high_, of equal height
};

}  // namespace talus
