// Motion without contact: translation, free spin, and how long nothing can be hit.
#include "step/flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "motion/free_rotation.hpp"
#include "motion/rotation.hpp"

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

/// A body on its path: its centroid `time` after the flight began, and how it was then.
struct Passing {
  const FlyingBody& body;
  Vec3 x, v, a;
  double time;
};

CellRange cells_passed(const Trn& trn, const Passing& at, double T) {
  const Range x = range_of(at.x.x(), at.v.x(), at.a.x(), T);
  const Range y = range_of(at.x.y(), at.v.y(), at.a.y(), T);
  return cells_near(trn, Vec3(x.low, y.low, 0), Vec3(x.high, y.high, 0), at.body.radius);
}

/// A plane of the ground: `up` is its normal over the cosine of the slope, whose inverse is
/// `length`; `height` is up . x of its points.
struct CellPlane {
  Vec3 up;
  double length, height;
};

CellPlane plane_of(const Trn& trn, const Cell& cell, bool upper) {
  const Vec2 gradient = triangle_gradient(trn, cell, upper);
  const Vec3 up(-gradient.x(), -gradient.y(), 1);
  return {up, std::sqrt(1 + gradient.squaredNorm()), up.dot(node_point(trn, cell.row, cell.col))};
}

CellPlane plane_of(const Trn& trn, const GridPoint& point) {
  return plane_of(trn, point.cell, is_upper(point));
}

// Time until c + v t + a t^2 / 2 falls to 0, c > 0, at most `longest`.
double time_to_zero(double c, double v, double a, double longest) {
  const bool stays = a <= 0 && c + longest * (v + longest / 2 * a) > 0;
  return stays ? longest : std::min(longest, first_zero(c, v, a));
}

// Time from the start of the flight until a vertex reaches the plane, 0 when one has; at most
// `longest`.
double time_of_vertices(const CellPlane& plane, const FlyingBody& body, const Vec3& a,
                        double longest) {
  const double height = plane.up.dot(body.position) - plane.height,
               rate = plane.up.dot(body.velocity),
               bend = plane.up.dot(a) - plane.length * body.bend * body.radius;
  const Vec3 up = body.R.transpose() * plane.up,
             turn = body.R.transpose() * plane.up.cross(body.spin);
  double first = longest;
  for (const Vec3& X : body.vertices) {
    const double gap = height + up.dot(X), speed = rate + turn.dot(X);
    if (gap > 0) {
      first = time_to_zero(gap, speed, bend, first);
      continue;
    }
    if (!(gap > -plane.length * body.touch && speed > 0)) return 0;
    if (bend < 0) first = std::min(first, -2 * speed / bend);
  }
  return first;
}

// Time until the body may reach the plane: until its ball and one of its vertices have. 0 when
// that is so already or when the triangle is not ground; `longest` when not before that.
double time_to_plane(const CellPlane& plane, const Passing& at, double longest) {
  const double height = plane.up.dot(at.x) - plane.height,
               gap = height - plane.length * at.body.radius;
  double by_ball = 0;
  if (gap > 0) by_ball = time_to_zero(gap, plane.up.dot(at.v), plane.up.dot(at.a), longest);
  if (by_ball >= longest || at.body.vertices.empty() || std::isnan(height)) return by_ball;
  const double until = at.time + longest;
  const double by_vertices = time_of_vertices(plane, at.body, at.a, until);
  return by_vertices < until ? std::max(by_ball, by_vertices - at.time) : longest;
}

// So few that their nodes are looked at one by one.
bool is_few(const CellRange& cells) {
  return cells.row_last - cells.row_first < TrnPyramid::tile_cells &&
         cells.col_last - cells.col_first < TrnPyramid::tile_cells;
}

// Heights of a cell's corners above the plane: north-west, north-east, south-west, south-east.
std::array<double, 4> corner_heights(const Trn& trn, int row, int col, const CellPlane& plane) {
  std::array<double, 4> heights;
  for (int k = 0; k < 4; ++k)
    heights[k] = plane.up.dot(node_point(trn, row + k / 2, col + k % 2)) - plane.height;
  return heights;
}

// Where the body touches the ground, it reaches any plane that is above all corners of triangles in
// the cells below: often the plane of the triangle below the centroid, over convex ground always;
// each other triangle has its own.
double time_to_ground(const Trn& trn, const CellRange& cells, const GridPoint& below,
                      const Passing& at, double longest) {
  const double flat = flat_ratio * trn.cell_size;
  const CellPlane plane = plane_of(trn, below);
  double first = time_to_plane(plane, at, longest);
  for (int row = cells.row_first; row <= cells.row_last && first > 0; ++row)
    for (int col = cells.col_first; col <= cells.col_last; ++col) {
      const auto [nw, ne, sw, se] = corner_heights(trn, row, col, plane);
      if (!(nw <= flat && sw <= flat && se <= flat))  // also where one is unknown
        first = time_to_plane(plane_of(trn, {row, col}, false), at, first);
      if (!(nw <= flat && ne <= flat && se <= flat))
        first = time_to_plane(plane_of(trn, {row, col}, true), at, first);
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

Motion motion_at(const Scene& scene, const State& state, int b, double time) {
  const auto i = static_cast<size_t>(b);
  if (state.phase[i] != Phase::flight || time == state.local_time[i]) return state.motion[i];
  return fly(state.motion[i], scene.blocks.inertia[i], scene.gravity, time - state.local_time[i]);
}

FlyingBody flying_body(const Motion& motion, const Vec3& inertia, double radius,
                       std::span<const Vec3> vertices) {
  FlyingBody body{motion.pose.position, motion.velocity, radius, vertices};
  if (vertices.empty()) return body;
  body.R = motion.pose.attitude.toRotationMatrix();
  if (motion.angular_momentum.isZero(0)) return body;
  const Vec3& L = motion.angular_momentum;
  body.spin = body.R * (body.R.transpose() * L).cwiseQuotient(inertia);
  // |omega x (omega x r)| <= omega^2 r, and |d omega / dt| <= omega^2 max|I_j - I_k| / I_i /
  // sqrt(3)
  const double fastest = fastest_spin(motion.pose.attitude, L, inertia);
  const double bends =
      (inertia.maxCoeff() - inertia.minCoeff()) / inertia.minCoeff() / std::sqrt(3);
  body.bend = fastest * fastest * (1 + bends);
  return body;
}

double free_time(const Ground& ground, const FlyingBody& body, const Vec3& a, double limit) {
  const Vec3 &x = body.position, &v = body.velocity;
  const double end = std::min(limit, time_on_grid(ground.trn, x, v, a));
  const double speed = v.head<2>().norm() + end * a.head<2>().norm();
  const double one_cell = ground.trn.cell_size / (speed + 1e-300);
  double t = 0, T = one_cell;
  while (t < end) {
    T = std::min(T, end - t);
    const Passing at{body, x + t * (v + t / 2 * a), v + t * a, a, t};
    const CellRange cells = cells_passed(ground.trn, at, T);
    if (cells.empty()) return t;
    const GridPoint below = locate(ground.trn, at.x.x(), at.x.y());
    if (is_few(cells) && is_below(ground.trn, cells, below)) {  // one plane tells for all of them
      const double touch = time_to_plane(plane_of(ground.trn, below), at, T);
      if (touch < T && T <= one_cell) return t + touch;
      if (touch == T) {
        t += T;
        T *= 2;
        continue;
      }
    }
    const ElevationRange range = elevation_range(ground.trn, ground.pyramid, cells);
    const double lowest = range_of(at.x.z(), at.v.z(), a.z(), T).low - body.radius;
    if (range.all_known && lowest > range.high) {  // far above: look farther ahead
      t += T;
      T *= 2;
    } else if (T > one_cell) {
      T = one_cell;
    } else {
      const double touch = time_to_ground(ground.trn, cells, below, at, T);
      if (touch < T) return t + touch;
      t += T;
    }
  }
  return end;
}

}  // namespace talus
