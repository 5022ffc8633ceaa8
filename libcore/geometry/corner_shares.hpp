// libcore/geometry/corner_shares.hpp: public
// The part of a convex polygon that belongs to each of its corners.
#pragma once

#include <cstddef>

#include "geometry/plan2d.hpp"

namespace talus {

/// Area of the convex polygon of `n` corners at(i), counter-clockwise; `take(i, share)` is called
/// with the parts that belong to corner i: half of each of the two triangles that it makes with the
/// polygon's centre of area, which keeps the area and its first moment exactly. 0 without a call
/// where its area is zero.
template <class At, class Take>
double share_area(std::size_t n, const At& at, const Take& take) {
  if (n < 3) return 0;
  double sum = 0;
  Vec2 centre = Vec2::Zero();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec2 p = at(i) - at(0), q = at(i + 1) - at(0);
    sum += cross(p, q);
    centre += cross(p, q) * (p + q);
  }
  if (!(sum > 0)) return 0;
  centre = at(0) + centre / (3 * sum);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = i + 1 == n ? 0 : i + 1;
    const double area = cross(at(i) - centre, at(next) - centre) / 4;
    take(i, area);
    take(next, area);
  }
  return sum / 2;
}

}  // namespace talus
