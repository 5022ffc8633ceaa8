// Drag of forests on blocks that pass their undergrowth and crowns.
#include "scene/canopy.hpp"

#include <algorithm>
#include <limits>

#include "terrain/dam.hpp"

namespace talus {
namespace {

/// Range of a coordinate over a motion.
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
    // off the known ground the elevation is not a number, and nothing is below a canopy
    if (position.z() < elevation_at(trn, at.x(), at.y()) + canopy.height &&
        canopy.area.contains(at) && !is_on_a_dam(trn, at))
      drag += canopy.drag;
  }
  return drag;
}

namespace {

// Adds where the height above the canopy's top is zero on a segment over ground that is linear
// in pieces; `low` and `high` are shares of the segment.
void add_top(const Canopy& canopy, const Trn& trn, const Vec3& from, const Vec3& to,
             std::vector<double>& shares) {
  constexpr int pieces = 4, halvings = 40;  // a substep goes over a few triangles at most
  const auto is_below = [&](double share) {
    const Vec3 x = from + share * (to - from);
    return x.z() < elevation_at(trn, x.x(), x.y()) + canopy.height;
  };
  for (int i = 0; i < pieces; ++i) {
    double low = static_cast<double>(i) / pieces, high = static_cast<double>(i + 1) / pieces;
    const bool begins_below = is_below(low);
    if (is_below(high) == begins_below) continue;
    for (int k = 0; k < halvings; ++k) {
      const double middle = (low + high) / 2;
      (is_below(middle) == begins_below ? low : high) = middle;
    }
    shares.push_back(high);
  }
}

}  // namespace

double mean_drag(const std::vector<Canopy>& canopies, const Trn& trn, const Vec3& from,
                 const Vec3& to) {
  const Vec2 low = from.head<2>().cwiseMin(to.head<2>()),
             high = from.head<2>().cwiseMax(to.head<2>());
  std::vector<double> shares;
  for (const Canopy& canopy : canopies) {
    if ((high.array() < canopy.low.array()).any() || (low.array() > canopy.high.array()).any())
      continue;
    canopy.area.add_crossings(from.head<2>(), to.head<2>(), shares);
    add_top(canopy, trn, from, to, shares);
  }
  shares.push_back(1);
  std::sort(shares.begin(), shares.end());
  double drag = 0, begin = 0;
  for (const double end : shares) {
    if (end > begin)
      drag += (end - begin) * drag_at(canopies, trn, from + (begin + end) / 2 * (to - from));
    begin = end;
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
