#include "scene/canopy.hpp"

#include <algorithm>
#include <limits>

namespace talus {
namespace {

/// What a coordinate takes on the way.
struct Range {
  double low, high;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
};

Range range_of(double x, double v, double a, double time) {
  Range range{x, x};
  const auto add = [&](double t) { range.add(x + t * (v + t / 2 * a)); };
  add(time);
  const double turn = -v / a;  // no number or infinite where nothing turns
  if (turn > 0 && turn < time) add(turn);
  return range;
}

}  // namespace

Canopy make_canopy(const Area& area, double height, double drag) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Canopy canopy{PreparedArea(area), Vec2::Constant(far), Vec2::Constant(-far), height, drag};
  for (const std::vector<Vec2>& ring : area.rings)
    for (const Vec2& point : ring) {
      canopy.low = canopy.low.cwiseMin(point);
      canopy.high = canopy.high.cwiseMax(point);
    }
  return canopy;
}

double drag_at(const std::vector<Canopy>& canopies, const Trn& trn, const Vec3& position) {
  const Vec2 at = position.head<2>();
  double drag = 0;
  for (const Canopy& canopy : canopies) {
    if ((at.array() < canopy.low.array()).any() || (at.array() > canopy.high.array()).any())
      continue;
    // off the known ground the elevation is no number, and nothing is below a canopy
    if (position.z() < elevation_at(trn, at.x(), at.y()) + canopy.height &&
        canopy.area.contains(at))
      drag += canopy.drag;
  }
  return drag;
}

bool comes_over(const std::vector<Canopy>& canopies, const Vec3& position, const Vec3& velocity,
                const Vec3& a, double time) {
  if (canopies.empty()) return false;
  const Range x = range_of(position.x(), velocity.x(), a.x(), time),
              y = range_of(position.y(), velocity.y(), a.y(), time);
  return std::any_of(canopies.begin(), canopies.end(), [&](const Canopy& canopy) {
    return x.low <= canopy.high.x() && canopy.low.x() <= x.high && y.low <= canopy.high.y() &&
           canopy.low.y() <= y.high;
  });
}

}  // namespace talus
