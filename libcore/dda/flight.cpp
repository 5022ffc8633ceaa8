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

// A ball about the centroid that holds the block, at the start of a part of its flight.
struct Ball {
  Vec3 x, v, a;
  double radius;
};

CellRange cells_passed(const Trn& trn, const Ball& ball, double T) {
  const Range x = range_of(ball.x.x(), ball.v.x(), ball.a.x(), T);
  const Range y = range_of(ball.x.y(), ball.v.y(), ball.a.y(), T);
  return cells_near(trn, Vec3(x.low, y.low, 0), Vec3(x.high, y.high, 0), ball.radius);
}

// Time until the ball reaches the plane of the triangle, 0 when it does so already or when the
// triangle is not ground; `longest` when not before that.
double time_to_plane(const Trn& trn, const Cell& cell, bool upper, const Ball& ball,
                     double longest) {
  const Vec2 gradient = triangle_gradient(trn, cell, upper);
  const Vec3 up(-gradient.x(), -gradient.y(), 1);  // times the cosine of the slope: the normal
  const double gap = up.dot(ball.x - node_point(trn, cell.row, cell.col)) -
                     ball.radius * std::sqrt(1 + gradient.squaredNorm());
  if (!(gap > 0)) return 0;
  const double rate = up.dot(ball.v), bend = up.dot(ball.a);
  const bool stays = bend <= 0 && gap + longest * (rate + longest / 2 * bend) > 0;
  return stays ? longest : std::min(longest, first_zero(gap, rate, bend));
}

// Where the ball touches the ground, it reaches the plane of a triangle in one of the cells below.
double time_to_touch(const Trn& trn, const CellRange& cells, const Ball& ball, double longest) {
  double first = longest;
  for (int row = cells.row_first; row <= cells.row_last; ++row)
    for (int col = cells.col_first; col <= cells.col_last; ++col)
      for (const bool upper : {false, true}) {
        first = time_to_plane(trn, {row, col}, upper, ball, first);
        if (first == 0) return 0;
      }
  return first;
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
  const double end = std::min(limit, time_on_grid(ground.trn, x, v, a));
  const double speed = v.head<2>().norm() + end * a.head<2>().norm();
  const double one_cell = ground.trn.cell_size / (speed + 1e-300);
  double t = 0, T = one_cell;
  while (t < end) {
    T = std::min(T, end - t);
    const Ball ball{x + t * (v + t / 2 * a), v + t * a, a, radius};
    const CellRange cells = cells_passed(ground.trn, ball, T);
    if (cells.empty()) return t;
    const ElevationRange range = elevation_range(ground.trn, ground.pyramid, cells);
    const double lowest = range_of(ball.x.z(), ball.v.z(), a.z(), T).low - radius;
    if (range.all_known && lowest > range.high) {  // far above: look farther ahead
      t += T;
      T *= 2;
    } else if (T > one_cell) {
      T = one_cell;
    } else {
      const double touch = time_to_touch(ground.trn, cells, ball, T);
      if (touch < T) return t + touch;
      t += T;
    }
  }
  return end;
}

}  // namespace talus
