// Convex outline of points in the plane by Andrew's monotone chain.
#include "geometry/convex_outline.hpp"

#include <algorithm>

namespace talus {

std::vector<Vec2> convex_outline(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto add = [&hull](const Vec2& p, std::size_t base) {
    const auto turns_left = [&] {
      const Vec2 &a = hull[hull.size() - 2], &b = hull.back();
      return (b.x() - a.x()) * (p.y() - b.y()) - (b.y() - a.y()) * (p.x() - b.x()) > 0;
    };
    while (hull.size() >= base + 2 && !turns_left()) hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto it = points.rbegin() + 1; it != points.rend(); ++it) add(*it, lower);
  hull.pop_back();
  return hull;
}

}  // namespace talus
