// Outlines in plan of the rock above failure planes.
#include "blocks/mass_outline.hpp"

#include <cmath>

#include "blocks/area_clip.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

// A height that is linear in plan: value at `at`, and slope.
struct Incline {
  Vec2 at = Vec2::Zero(), gradient = Vec2::Zero();
  double value = 0;
  [[nodiscard]] double operator()(const Vec2& p) const { return value + gradient.dot(p - at); }
};

Incline incline_of(const PlaneThrough& plane) {
  const double azimuth = plane.attitude.dip_direction;
  return {plane.point.head<2>(),
          -std::tan(plane.attitude.dip) * Vec2(std::sin(azimuth), std::cos(azimuth)),
          plane.point.z()};
}

// The part of a convex ring where `height` is above zero.
std::vector<Vec2> part_above(const std::vector<Vec2>& ring, const Incline& height) {
  std::vector<Vec2> part;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
    const double at_a = height(a), at_b = height(b);
    if (at_a >= 0) part.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0))
      part.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return part;
}

// Of a height over a convex ring; 0 for one without an area.
double volume_under(const std::vector<Vec2>& ring, const Incline& height) {
  double volume = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const Vec2 a = ring[k] - ring[0], b = ring[k + 1] - ring[0];
    const double area = cross(a, b) / 2;
    volume += area * (height(ring[0]) + height(ring[k]) + height(ring[k + 1])) / 3;
  }
  return volume;
}

Incline difference(const Incline& upper, const Incline& lower) {
  return {upper.at, upper.gradient - lower.gradient, upper.value - lower(upper.at)};
}

}  // namespace

std::vector<MassPiece> mass_above(const Trn& ground, const Area& area,
                                  const std::vector<PlaneThrough>& planes) {
  std::vector<Incline> bed;
  for (const PlaneThrough& plane : planes) bed.push_back(incline_of(plane));
  std::vector<MassPiece> pieces;
  for (const TriangleInArea& inside : triangles_in(ground, area)) {
    if (!is_known(ground, inside.triangle)) continue;
    const Vec3 corner = triangle_corners(ground, inside.triangle)[0];
    const Incline top{corner.head<2>(), triangle_gradient(ground, inside.triangle), corner.z()};
    for (const std::vector<Vec2>& ring : inside.pieces)
      for (std::size_t on = 0; on < bed.size(); ++on) {
        const Incline depth = difference(top, bed[on]);
        std::vector<Vec2> part = part_above(ring, depth);
        for (std::size_t other = 0; other < bed.size(); ++other)
          if (other != on) part = part_above(part, difference(bed[on], bed[other]));
        const double volume = volume_under(part, depth);
        if (volume > 0) pieces.push_back({std::move(part), static_cast<int>(on), volume});
      }
  }
  return pieces;
}

}  // namespace talus
