#include "dda/flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dda/rotation.hpp"

namespace talus {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// First t > 0 at which c + v t + a t^2 / 2 falls to 0, c > 0.
double first_zero(double c, double v, double a) {
  const double discriminant = v * v - 2 * a * c;
  if (discriminant < 0) return never;
  const double root = std::sqrt(discriminant);
  if (v <= 0 && root > v) return 2 * c / (root - v);  // falling, or at rest with a < 0
  return a < 0 ? (v + root) / -a : never;
}

/// Range of x + v t + a t^2 / 2 over 0..T.
struct Range {
  double low, high;
};
Range range_of(double x, double v, double a, double T) {
  const double end = x + T * (v + a * T / 2);
  Range range{std::min(x, end), std::max(x, end)};
  const double turn = a != 0 ? -v / a : never;
  if (turn > 0 && turn < T) {
    const double at = x + v * turn / 2;
    range.low = std::min(range.low, at);
    range.high = std::max(range.high, at);
  }
  return range;
}

// Time until the centroid crosses the grid's edge.
double time_on_grid(const Trn& trn, const Vec3& x, const Vec3& v, const Vec3& a) {
  const double west = trn.node0.x(), east = west + (trn.n_cols - 1) * trn.cell_size;
  const double north = trn.node0.y(), south = north - (trn.n_rows - 1) * trn.cell_size;
  if (!(x.x() > west && x.x() < east && x.y() > south && x.y() < north)) return 0;
  return std::min({first_zero(x.x() - west, v.x(), a.x()), first_zero(east - x.x(), -v.x(), -a.x()),
                   first_zero(x.y() - south, v.y(), a.y()),
                   first_zero(north - x.y(), -v.y(), -a.y())});
}

}  // namespace

Motion fly(const Motion& motion, const Vec3& inertia, const Vec3& a, double h) {
  Motion end = motion;
  end.pose.position += h * (motion.velocity + (h / 2) * a);
  end.velocity += h * a;
  end.pose.attitude = free_rotation(motion.pose.attitude, motion.angular_momentum, inertia, h);
  return end;
}

double free_time(const Ground& ground, double radius, const Vec3& x, const Vec3& v, const Vec3& a,
                 double limit) {
  double T = std::min(limit, time_on_grid(ground.trn, x, v, a));
  double safe = 0;
  for (int i = 0; i < 10 && T > safe; ++i, T /= 2) {
    const Range rx = range_of(x.x(), v.x(), a.x(), T), ry = range_of(x.y(), v.y(), a.y(), T);
    const CellRange cells =
        cells_near(ground.trn, Vec3(rx.low, ry.low, 0), Vec3(rx.high, ry.high, 0), radius);
    if (cells.empty()) return safe;
    const double top = elevation_range(ground.trn, ground.pyramid, cells).high;
    const double clearance = x.z() - radius - top;
    if (!(clearance > 0)) continue;
    safe = std::max(safe, std::min(T, first_zero(clearance, v.z(), a.z())));
  }
  return safe;
}

}  // namespace talus
