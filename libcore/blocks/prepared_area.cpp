// An area prepared for many queries of points and crossings.
#include "blocks/prepared_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "blocks/area_side.hpp"

namespace talus {

using std::size_t;

// As many bands as sides of the mean height fit into: each side is in two or three of them.
PreparedArea::PreparedArea(const Area& area) {
  std::vector<Side> sides;
  double sum = 0;
  low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
  for (const auto& ring : area.rings)
    for (size_t k = 0; k < ring.size(); ++k) {
      sides.push_back({ring[k], ring[(k + 1) % ring.size()]});
      low_ = std::min(low_, ring[k].y()), high_ = std::max(high_, ring[k].y());
      sum += std::abs(sides.back().b.y() - sides.back().a.y());
    }
  if (sides.empty()) low_ = high_ = 0;
  const double n = static_cast<double>(sides.size());
  const double wanted = sum > 0 ? n * (high_ - low_) / sum : 1;
  bands_.resize(static_cast<size_t>(std::clamp(wanted, 1.0, std::max(1.0, n))));
  per_height_ = high_ > low_ ? static_cast<double>(bands_.size()) / (high_ - low_) : 0;
  for (const Side& side : sides) {
    const double room = reach_of(side.a, side.b);
    const size_t last = band_of(std::max(side.a.y(), side.b.y()) + room);
    for (size_t band = band_of(std::min(side.a.y(), side.b.y()) - room); band <= last; ++band)
      bands_[band].push_back(side);
  }
}

size_t PreparedArea::band_of(double y) const {
  const double band =
      std::clamp((y - low_) * per_height_, 0.0, static_cast<double>(bands_.size() - 1));
  return static_cast<size_t>(band);
}

size_t PreparedArea::n_looked_at(const Vec2& point) const {
  return bands_[band_of(point.y())].size();
}

void PreparedArea::add_crossings(const Vec2& from, const Vec2& to,
                                 std::vector<double>& shares) const {
  const Vec2 along = to - from;
  const size_t last = band_of(std::max(from.y(), to.y()));
  for (size_t band = band_of(std::min(from.y(), to.y())); band <= last; ++band)
    for (const auto& [a, b] : bands_[band]) {
      // both ends of the side on one side of the segment: it is not crossed
      const double left_a = cross(along, a - from), left_b = cross(along, b - from);
      if (left_a * left_b > 0 || left_a == left_b) continue;
      const double share = cross(a - from, b - a) / cross(along, b - a);
      if (share > 0 && share < 1) shares.push_back(share);
    }
}

bool PreparedArea::contains(const Vec2& point) const {
  if (!point.allFinite()) return false;
  bool inside = false;
  for (const auto& [a, b] : bands_[band_of(point.y())]) {
    if (on_segment(a, b, point)) return true;
    if (is_left_of(a, b, point)) inside = !inside;
  }
  return inside;
}

}  // namespace talus
