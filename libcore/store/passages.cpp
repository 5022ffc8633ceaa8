#include "store/passages.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "base/text.hpp"
#include "terrain/trn_pyramid.hpp"
#include "terrain/trn_walk.hpp"

namespace talus {
namespace {

constexpr double largest_turn = 0.25;  // of a piece [rad]

// --- axes --------------------------------------------------------------------------------------

struct Axes {
  AxisArray x, y;
  AxisArray half_cell;  // half the extent of a cell of size 1
  Axes() {
    for (int k = 0; k < n_footprint_axes; ++k) {
      const double angle = k * std::numbers::pi / n_footprint_axes;
      x[k] = std::cos(angle);
      y[k] = std::sin(angle);
    }
    x[n_footprint_axes / 2] = 0;  // not 6e-17: the axes along the grid are exact
    half_cell = 0.5 * (x.abs() + y.abs());
  }
  [[nodiscard]] AxisArray project(const Vec2& point) const { return point.x() * x + point.y() * y; }
};
const Axes axes;

Extents extents_of(const Shapes& shapes, int block, const Quat& attitude) {
  const Mat3 turn = attitude.toRotationMatrix();
  Extents extents;
  extents.low.setConstant(std::numeric_limits<double>::infinity());
  extents.high.setConstant(-std::numeric_limits<double>::infinity());
  for (const Vec3& vertex : vertices_of(shapes, block)) {
    const AxisArray at = turn.row(0).dot(vertex) * axes.x + turn.row(1).dot(vertex) * axes.y;
    extents.low = extents.low.min(at);
    extents.high = extents.high.max(at);
  }
  return extents;
}

void widen(Extents& extents, double by) {
  extents.low -= by;
  extents.high += by;
}

// --- the moments between which a piece runs ----------------------------------------------------

PassageInstant instant_of(const Scene& scene, int block, const Motion& motion) {
  PassageInstant instant;
  instant.motion = motion;
  const Vec3 up = motion.pose.attitude.toRotationMatrix().row(2);
  const std::span<const Vec3> vertices = vertices_of(scene.blocks.shapes, block);
  instant.top = up.dot(vertices.front());
  for (const Vec3& vertex : vertices) instant.top = std::max(instant.top, up.dot(vertex));
  instant.spin_energy = rotational_energy(motion, scene.blocks.inertia[block]);
  return instant;
}

bool same_motion(const Motion& a, const Motion& b) {
  return a.velocity == b.velocity && a.angular_momentum == b.angular_momentum &&
         a.pose.position == b.pose.position && a.pose.attitude.coeffs() == b.pose.attitude.coeffs();
}

// A piece of motion, straight in plan, with less than `largest_turn` between its ends.
struct Piece {
  int block = 0;
  PassageInstant a, b;
  double t_start = 0, duration = 0;
  double sag = 0;      // a_z h^2 / 2 [m]
  double turn = 0;     // the attitude turns by less [rad]
  double sagitta = 0;  // of a vertex's way by turning, from above [m]
};

Vec2 plan(const Motion& motion) { return motion.pose.position.head<2>(); }

// Angle between two attitudes, from above: theta = 4 asin(d / 2) <= 2.1 d for d <= 0.9.
double turn_bound(const Quat& a, const Quat& b) {
  const double same = (a.coeffs() - b.coeffs()).norm(), other = (a.coeffs() + b.coeffs()).norm();
  return 2.1 * std::min(same, other);
}

PassageValues values_between(const Scene& scene, const Piece& piece, double s_in, double s_out) {
  const double mass = scene.blocks.mass[piece.block];
  const Motion &a = piece.a.motion, &b = piece.b.motion;
  PassageValues values;
  double fastest_sq = 0;
  for (const double s : {s_in, s_out}) {  // |v(s)|^2 is convex: largest at an end
    const double speed_sq = (a.velocity + s * (b.velocity - a.velocity)).squaredNorm();
    const double spin = piece.a.spin_energy + s * (piece.b.spin_energy - piece.a.spin_energy);
    const double translation = 0.5 * mass * speed_sq;
    fastest_sq = std::max(fastest_sq, speed_sq);
    values.translational_energy =
        std::max(values.translational_energy, static_cast<float>(translation));
    values.total_energy = std::max(values.total_energy, static_cast<float>(translation + spin));
  }
  values.speed = static_cast<float>(std::sqrt(fastest_sq));
  const Heights heights = largest_heights(
      scene.ground.trn, {a.pose.position, b.pose.position, piece.a.top, piece.b.top, piece.sag},
      s_in, s_out);
  values.centroid_height = static_cast<float>(heights.centroid);
  values.top_height = static_cast<float>(heights.top);
  return values;
}

// --- cells below a footprint -------------------------------------------------------------------

struct CellBox {
  CellRange cells;    // clipped to the grid
  double margin = 0;  // from the extent's sides to the grid lines beyond [m]
};

// Cells below the box low..high (map orientation: x east, y north).
CellBox cells_below(const PassageGrid& grid, const Vec2& low, const Vec2& high) {
  const double west = (low.x() - grid.corner.x()) / grid.cell_size;
  const double east = (high.x() - grid.corner.x()) / grid.cell_size;
  const double north = (grid.corner.y() - high.y()) / grid.cell_size;
  const double south = (grid.corner.y() - low.y()) / grid.cell_size;
  CellBox box;
  const double inside = std::min({west - std::floor(west), std::ceil(east) - east,
                                  north - std::floor(north), std::ceil(south) - south});
  box.margin = inside * grid.cell_size;
  if (!(west < grid.n_cols && east > 0 && north < grid.n_rows && south > 0)) return box;
  const auto index = [](double value, int n) {
    return static_cast<int>(std::clamp(std::floor(value), 0.0, n - 1.0));
  };
  box.cells = {index(north, grid.n_rows), index(std::ceil(south) - 1, grid.n_rows),
               index(west, grid.n_cols), index(std::ceil(east) - 1, grid.n_cols)};
  return box;
}

Vec2 cell_centre(const PassageGrid& grid, int row, int col) {
  return grid.corner + grid.cell_size * Vec2(col + 0.5, -row - 0.5);
}

template <class Visit>
void for_each_cell(const CellRange& range, Visit&& visit) {
  for (int row = range.row_first; row <= range.row_last; ++row)
    for (int col = range.col_first; col <= range.col_last; ++col) visit(row, col);
}

int cell_index(const PassageGrid& grid, int row, int col) { return row * grid.n_cols + col; }

// The part of 0..1 where all of value + s * rate are positive; none when in >= out.
struct Share {
  double in = 0, out = 1;
  void keep_positive(const AxisArray& value, const AxisArray& rate) {
    const AxisArray zero = -value / rate;
    for (int k = 0; k < n_footprint_axes; ++k) {
      if (rate[k] > 0)
        in = std::max(in, zero[k]);
      else if (rate[k] < 0)
        out = std::min(out, zero[k]);
      else if (!(value[k] > 0))
        out = -1;
    }
  }
};

// A footprint at one end of a piece.
struct Footprint {
  Vec2 at;
  Extents extents;
  [[nodiscard]] Vec2 low() const {
    return at + Vec2(extents.low[0], extents.low[n_footprint_axes / 2]);
  }
  [[nodiscard]] Vec2 high() const {
    return at + Vec2(extents.high[0], extents.high[n_footprint_axes / 2]);
  }
};

// Calls visit(cell, s_in, s_out) for every cell that the footprint lies over on its way from `a` to
// `b`: while their extents overlap along each axis.
template <class Visit>
void sweep(const PassageGrid& grid, const Footprint& a, const Footprint& b, Visit&& visit) {
  const CellBox box = cells_below(grid, a.low().cwiseMin(b.low()), a.high().cwiseMax(b.high()));
  const AxisArray place = axes.project(a.at), rate = axes.project(b.at - a.at);
  const AxisArray low = place + a.extents.low, high = place + a.extents.high;
  const AxisArray low_rate = rate + b.extents.low - a.extents.low;
  const AxisArray high_rate = rate + b.extents.high - a.extents.high;
  const AxisArray half = grid.cell_size * axes.half_cell;
  for_each_cell(box.cells, [&](int row, int col) {
    const AxisArray centre = axes.project(cell_centre(grid, row, col));
    Share share;
    share.keep_positive(high - centre + half, high_rate);
    if (!(share.in < share.out)) return;
    share.keep_positive(centre + half - low, -low_rate);
    if (share.in < share.out) visit(cell_index(grid, row, col), share.in, share.out);
  });
}

// The cells below the footprint at rest, and how far its points may move before they change.
void find_covered(const PassageGrid& grid, const Footprint& footprint, PassageTracker& tracker) {
  const CellBox box = cells_below(grid, footprint.low(), footprint.high());
  const AxisArray place = axes.project(footprint.at), half = grid.cell_size * axes.half_cell;
  const AxisArray low = place + footprint.extents.low, high = place + footprint.extents.high;
  tracker.covered.clear();
  tracker.margin = box.margin;
  for_each_cell(box.cells, [&](int row, int col) {
    const AxisArray centre = axes.project(cell_centre(grid, row, col));
    const double separation = (low - centre - half).max(centre - half - high).maxCoeff();
    tracker.margin = std::min(tracker.margin, std::abs(separation));
    if (separation < 0) tracker.covered.push_back(cell_index(grid, row, col));
  });
}

// The same for the centroid alone, which a grid line puts into the cell east or south of it.
void find_covered(const PassageRecorder& recorder, const Vec2& at, PassageTracker& tracker) {
  tracker.covered.clear();
  tracker.margin = 0;
  walk_cells(recorder.frame, at, at, [&](const CellPart& part) {
    const Vec2 off = at - cell_centre(recorder.grid, part.cell.row, part.cell.col);
    tracker.covered.push_back(cell_index(recorder.grid, part.cell.row, part.cell.col));
    tracker.margin = std::max(0.0, 0.5 * recorder.grid.cell_size - off.cwiseAbs().maxCoeff());
  });
}

// The end of a piece is asked for again as its cells and as the start of the next.
Footprint footprint_of(PassageRecorder& recorder, const Scene& scene, int block,
                       const Motion& motion) {
  LastExtents& last = recorder.last_extents[block];
  const Quat& attitude = motion.pose.attitude;
  if (last.attitude.coeffs() != attitude.coeffs())
    last = {attitude, extents_of(scene.blocks.shapes, block, attitude)};
  return {plan(motion), last.extents};
}

// --- recording ---------------------------------------------------------------------------------

// The row of a block that comes over a cell now, `path` from its start.
Passage arrival(int block, const PassageTracker& tracker, double time, double z, double path,
                const Vec3& velocity) {
  Passage row;
  row.block = block;
  row.first_time = static_cast<float>(time);
  if (path > 0) row.travel_angle = static_cast<float>(std::atan2(tracker.start_z - z, path));
  if (velocity.x() != 0 || velocity.y() != 0)
    row.heading = static_cast<float>(std::atan2(velocity.y(), velocity.x()));
  return row;
}

void flush(PassageTable& table, int block, const PassageTracker& tracker) {
  const Motion& motion = tracker.last.motion;
  for (const int cell : tracker.covered) {
    if (Passage* known = table.earlier(block, cell, static_cast<float>(tracker.last_time))) {
      known->largest.raise(tracker.pending);
      continue;
    }
    Passage row = arrival(block, tracker, tracker.last_time, motion.pose.position.z(), tracker.path,
                          motion.velocity);
    row.largest = tracker.pending;
    row.cell = cell;
    table.raise(row);
  }
}

// The block at the end of `piece`: its cells, and its values there as the first of the new set.
void settle(PassageRecorder& recorder, const Scene& scene, const Piece& piece) {
  PassageTracker& tracker = recorder.trackers[piece.block];
  const Vec2 at = plan(piece.b.motion);
  if (recorder.by_centroid)
    find_covered(recorder, at, tracker);
  else
    find_covered(recorder.grid, footprint_of(recorder, scene, piece.block, piece.b.motion),
                 tracker);
  tracker.pending = values_between(scene, piece, 1, 1);
}

// What a piece passes when the covered cells may change in it.
void record_sweep(PassageRecorder& recorder, const Scene& scene, const Piece& piece,
                  const PassageValues& whole) {
  const Motion &a = piece.a.motion, &b = piece.b.motion;
  const PassageTracker& tracker = recorder.trackers[piece.block];
  const Vec3 way = b.pose.position - a.pose.position;
  const auto visit = [&](int cell, double s_in, double s_out) {
    const double time = piece.t_start + s_in * piece.duration;
    const PassageValues values =
        s_in <= 0 && s_out >= 1 ? whole : values_between(scene, piece, s_in, s_out);
    if (Passage* known = recorder.table.earlier(piece.block, cell, static_cast<float>(time))) {
      known->largest.raise(values);
      return;
    }
    const double z = a.pose.position.z() + s_in * way.z() - piece.sag * s_in * (1 - s_in);
    Passage row = arrival(piece.block, tracker, time, z, tracker.path + s_in * way.head<2>().norm(),
                          a.velocity + s_in * (b.velocity - a.velocity));
    row.cell = cell;
    row.largest = values;
    recorder.table.raise(row);
  };
  if (recorder.by_centroid) {
    walk_cells(recorder.frame, plan(a), plan(b), [&](const CellPart& part) {
      visit(cell_index(recorder.grid, part.cell.row, part.cell.col), part.t_in, part.t_out);
    });
    return;
  }
  Footprint start = footprint_of(recorder, scene, piece.block, a);
  Footprint end = footprint_of(recorder, scene, piece.block, b);
  widen(start.extents, piece.sagitta);
  widen(end.extents, piece.sagitta);
  sweep(recorder.grid, start, end, visit);
}

// The tracker at the end of a piece, or of several.
void follow(PassageTracker& tracker, const PassageInstant& end, double time) {
  tracker.path += (plan(end.motion) - plan(tracker.last.motion)).norm();
  tracker.last = end;
  tracker.last_time = time;
}

// A piece in which the covered cells may change.
void record_change(PassageRecorder& recorder, const Scene& scene, const Piece& piece) {
  flush(recorder.table, piece.block, recorder.trackers[piece.block]);
  record_sweep(recorder, scene, piece, values_between(scene, piece, 0, 1));
  settle(recorder, scene, piece);
}

// A step with contact: one piece as a rule.
void record_piece(PassageRecorder& recorder, const Scene& scene, const Piece& piece) {
  PassageTracker& tracker = recorder.trackers[piece.block];
  const Motion &a = piece.a.motion, &b = piece.b.motion;
  const double moved =
      (plan(b) - plan(a)).norm() +
      (recorder.by_centroid ? 0 : scene.blocks.shapes.radius[piece.block] * piece.turn);
  if (moved < tracker.margin || moved == 0) {
    tracker.margin -= moved;
    tracker.pending.raise(values_between(scene, piece, 0, 1));
  } else {
    record_change(recorder, scene, piece);
  }
  follow(tracker, piece.b, piece.t_start + piece.duration);
}

// From above, by how much a block turns in a segment [rad]. In flight the rate of omega is at most
// |omega|^2 (Euler's equations): a vertex's acceleration by turning is below 2 r |omega|^2.
double turn_of(const Segment& segment, const Vec3& inertia) {
  return segment.flight ? flight_turn(segment, inertia)
                        : turn_bound(segment.start.pose.attitude, segment.end.pose.attitude);
}

// So many pieces that each turns by less than `largest_turn` and bends in plan by less than a
// hundredth of a cell (a flight over shaking ground is a parabola in plan too).
int n_pieces(const Segment& segment, double turn, double cell_size) {
  const double duration = segment.t_end - segment.t_start;
  const double bend = segment.acceleration.head<2>().norm() * duration * duration / 8;
  const double n = std::max(turn / largest_turn, std::sqrt(bend / (0.01 * cell_size)));
  return std::max(1, static_cast<int>(std::ceil(n)));
}

// --- flights -----------------------------------------------------------------------------------

struct PlanBox {
  Vec2 low, high;
};

// The covered cells, as long as they lie in one row or one column; then a footprint covers just
// these as long as it stays in `outer` and reaches beyond both sides of `inner`.
struct CoveredStrip {
  bool is_strip = false;
  PlanBox outer, inner;
};

CoveredStrip strip_of(const PassageGrid& grid, const std::vector<int>& covered) {
  CoveredStrip strip;
  if (covered.empty()) return strip;
  const int row0 = covered.front() / grid.n_cols, col0 = covered.front() % grid.n_cols;
  const int row1 = covered.back() / grid.n_cols, col1 = covered.back() % grid.n_cols;
  const auto n = static_cast<std::size_t>((row1 - row0 + 1) * (col1 - col0 + 1));
  strip.is_strip = (row0 == row1 || col0 == col1) && n == covered.size();
  const auto node = [&](int row, int col) {
    return Vec2(grid.corner.x() + col * grid.cell_size, grid.corner.y() - row * grid.cell_size);
  };
  strip.outer = {node(row1 + 1, col0), node(row0, col1 + 1)};
  strip.inner = {node(row1, col0 + 1), node(row0 + 1, col1)};
  return strip;
}

// Everything about the block at `motion` that one pass over its vertices gives.
FlightInstant flight_instant(const Scene& scene, int block, const Motion& motion,
                             double spin_energy) {
  const Mat3 turn = motion.pose.attitude.toRotationMatrix();
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& vertex : vertices_of(scene.blocks.shapes, block)) {
    const Vec3 at = vertex.x() * turn.col(0) + vertex.y() * turn.col(1) + vertex.z() * turn.col(2);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const Vec2 centre = plan(motion);
  return {true, {motion, high.z(), spin_energy}, centre + low.head<2>(), centre + high.head<2>()};
}

// The pieces of one flight. Where the block is followed piece by piece and where not depends on
// what can change: cells only near their sides, and the largest height of the block's top only
// where its centroid is nearly as high as it gets.
struct FlightRecord {
  PassageRecorder& recorder;
  const Scene& scene;
  SegmentMotion& motion;
  int n = 1;             // pieces
  Piece piece{};         // the one at hand; sag, sagitta, turn and duration are those of all
  int n_pending = 0;     // pieces before this are in the tracker's pending values
  double top_bound = 0;  // no vertex is higher above the centroid [m]
  double spin_energy_start = 0, spin_energy_end = 0;  // [J]

  [[nodiscard]] const Segment& segment() const { return motion.segment(); }
  [[nodiscard]] PassageTracker& tracker() const { return recorder.trackers[piece.block]; }
  [[nodiscard]] double time_at(int k) const {
    return k < n ? segment().t_start + k * piece.duration : segment().t_end;
  }
  [[nodiscard]] double spin_energy_at(int k) const {  // nothing turns it but at a load on a point
    return k < n ? spin_energy_start : spin_energy_end;
  }
  [[nodiscard]] Vec3 position_at(int k) const {
    if (k == 0 || k == n) return (k == 0 ? segment().start : segment().end).pose.position;
    const double t = k * piece.duration;
    return segment().start.pose.position + t * segment().start.velocity +
           0.5 * t * t * segment().acceleration;
  }

  const FlightInstant& instant_at(int k) {
    FlightInstant& found = recorder.flight_instants[static_cast<std::size_t>(k)];
    if (!found.known)
      found = flight_instant(scene, piece.block, motion.at(time_at(k)), spin_energy_at(k));
    return found;
  }

  [[nodiscard]] HeightPath path(int from, int to) const {
    const double duration = (to - from) * piece.duration;
    return {position_at(from), position_at(to), 0, 0,
            0.5 * segment().acceleration.z() * duration * duration};
  }
  // Largest height of the centroid in some pieces.
  [[nodiscard]] double highest(int from, int to) const {
    return largest_heights(scene.ground.trn, path(from, to), 0, 1).centroid;
  }

  // Raises the top's height by that in some pieces, in which the centroid comes as high as
  // `centroid`: in halves, the higher one first, as long as the top may come higher than it has.
  void raise_top(int from, int to, double centroid) {
    float& top = tracker().pending.top_height;
    if (std::isnan(centroid) || static_cast<float>(centroid + top_bound) <= top) return;
    if (to - from == 1) {
      HeightPath way = path(from, to);
      way.top_from = instant_at(from).instant.top;
      way.top_to = instant_at(to).instant.top;
      const auto height = static_cast<float>(largest_heights(scene.ground.trn, way, 0, 1).top);
      if (!(height <= top)) top = height;
      return;
    }
    const int middle = (from + to) / 2;
    const double before = highest(from, middle), after = highest(middle, to);
    if (!(after > before)) raise_top(from, middle, before);
    raise_top(middle, to, after);
    if (after > before) raise_top(from, middle, before);
  }

  // The pieces up to k, in which the covered cells stayed, into the pending values.
  void raise_pending(int k) {
    if (k == n_pending) return;
    const double mass = scene.blocks.mass[piece.block];
    const double centroid = highest(n_pending, k);
    PassageValues values;
    for (const int end : {n_pending, k}) {  // |v|^2 is convex in time: largest at an end
      const double speed_sq = velocity_at(end).squaredNorm();
      const double translation = 0.5 * mass * speed_sq;
      values.speed = std::max(values.speed, static_cast<float>(std::sqrt(speed_sq)));
      values.translational_energy =
          std::max(values.translational_energy, static_cast<float>(translation));
      values.total_energy =
          std::max(values.total_energy, static_cast<float>(translation + spin_energy_at(end)));
    }
    values.centroid_height = static_cast<float>(centroid);
    tracker().pending.raise(values);
    raise_top(n_pending, k, centroid);
    n_pending = k;
  }
  [[nodiscard]] Vec3 velocity_at(int k) const {
    if (k == 0 || k == n) return (k == 0 ? segment().start : segment().end).velocity;
    return segment().start.velocity + k * piece.duration * segment().acceleration;
  }

  // The last piece up to which a ball around the block stays over the only cell that is covered.
  [[nodiscard]] int end_in_cell(int k, const CoveredStrip& strip) const {
    if (tracker().covered.size() != 1 || !segment().acceleration.head<2>().isZero(0)) return k;
    const double radius = recorder.by_centroid ? 0 : scene.blocks.shapes.radius[piece.block];
    const Vec2 at = position_at(k).head<2>(), velocity = segment().start.velocity.head<2>();
    double longest = (n - k) * piece.duration;
    for (int axis = 0; axis < 2; ++axis) {
      const double low = at[axis] - radius - strip.outer.low[axis];
      const double high = strip.outer.high[axis] - radius - at[axis];
      if (!(low > 0 && high > 0)) return k;
      const double ahead = velocity[axis] > 0 ? high : low;
      if (velocity[axis] != 0) longest = std::min(longest, ahead / std::abs(velocity[axis]));
    }
    return k + static_cast<int>(longest / piece.duration * (1 - 1e-12));
  }

  // Whether the footprint covers the same cells all through piece k: its extents go linearly.
  [[nodiscard]] bool stays(int k, const CoveredStrip& strip) {
    if (recorder.by_centroid || !strip.is_strip) return false;
    const FlightInstant &a = instant_at(k), &b = instant_at(k + 1);
    const auto wide = Vec2::Constant(piece.sagitta);
    return (a.low.cwiseMin(b.low) - wide - strip.outer.low).minCoeff() > 0 &&
           (strip.outer.high - a.high.cwiseMax(b.high) - wide).minCoeff() > 0 &&
           (strip.inner.low - a.low.cwiseMax(b.low)).minCoeff() > 0 &&
           (a.high.cwiseMin(b.high) - strip.inner.high).minCoeff() > 0;
  }

  void run() {
    recorder.flight_instants.assign(static_cast<std::size_t>(n) + 1, {});
    CoveredStrip strip = strip_of(recorder.grid, tracker().covered);
    for (int k = 0; k < n;) {
      k = end_in_cell(k, strip);
      if (k == n) break;
      if (!stays(k, strip)) {
        raise_pending(k);
        piece.t_start = time_at(k);
        piece.a = instant_at(k).instant;
        piece.b = instant_at(k + 1).instant;
        follow(tracker(), piece.a, piece.t_start);
        record_change(recorder, scene, piece);
        follow(tracker(), piece.b, time_at(k + 1));
        n_pending = k + 1;
        strip = strip_of(recorder.grid, tracker().covered);
      }
      ++k;
    }
    raise_pending(n);
    follow(tracker(), instant_at(n).instant, segment().t_end);
    tracker().margin = 0;
  }
};

}  // namespace

PassageGrid passage_grid(const Trn& trn, double cell_size) {
  if (!(cell_size > 0)) return {trn.node0, trn.cell_size, trn.n_rows - 1, trn.n_cols - 1};
  const auto n_cells = [&](int n_trn_cells) {  // a whole number of cells, but for rounding
    return static_cast<int>(std::ceil(n_trn_cells * trn.cell_size / cell_size - 1e-9));
  };
  const double along_trn = trn.cell_size / cell_size;
  const double n = along_trn * (trn.n_rows - 1) * along_trn * (trn.n_cols - 1);
  constexpr double most_cells = 1e8;
  if (n > most_cells)
    throw InputError({"", 0, "output.cell_size_m"},
                     "cells of " + text(cell_size) + " m are " + text(n, 3) +
                         " cells on this terrain, expected up to " + text(most_cells),
                     "give a larger cell_size_m");
  return {trn.node0, cell_size, n_cells(trn.n_rows - 1), n_cells(trn.n_cols - 1)};
}

PassageRecorder start_passages(const Scene& scene, const PassageGrid& grid, bool by_centroid) {
  PassageRecorder recorder;
  recorder.grid = grid;
  recorder.frame.n_rows = grid.n_rows + 1;
  recorder.frame.n_cols = grid.n_cols + 1;
  recorder.frame.cell_size = grid.cell_size;
  recorder.frame.node0 = grid.corner;
  recorder.by_centroid = by_centroid;
  recorder.trackers.resize(static_cast<std::size_t>(n_blocks(scene)));
  recorder.last_extents.resize(static_cast<std::size_t>(n_blocks(scene)));
  return recorder;
}

void record_start(PassageRecorder& recorder, const Scene& scene, int block, const Motion& motion,
                  double time) {
  const PassageInstant instant = instant_of(scene, block, motion);
  PassageTracker& tracker = recorder.trackers[block];
  tracker.last = instant;
  tracker.last_time = time;
  tracker.start_z = motion.pose.position.z();
  Piece still;
  still.block = block;
  still.a = still.b = instant;
  still.t_start = time;
  settle(recorder, scene, still);
  flush(recorder.table, block, tracker);
}

void record_passages(PassageRecorder& recorder, const Scene& scene, SegmentMotion& motion) {
  const Segment& segment = motion.segment();
  const int block = segment.block;
  const double turn = turn_of(segment, scene.blocks.inertia[block]);
  const int n = n_pieces(segment, turn, recorder.grid.cell_size);
  const double radius = scene.blocks.shapes.radius[block];
  PassageTracker& tracker = recorder.trackers[block];
  Piece piece;
  piece.block = block;
  piece.duration = (segment.t_end - segment.t_start) / n;
  piece.sag = 0.5 * segment.acceleration.z() * piece.duration * piece.duration;
  piece.turn = turn / n;
  piece.sagitta = radius * piece.turn * piece.turn / (segment.flight ? 4 : 8);
  piece.a = same_motion(tracker.last.motion, segment.start)
                ? tracker.last
                : instant_of(scene, block, segment.start);
  if (segment.flight) {
    const double end = rotational_energy(segment.end, scene.blocks.inertia[block]);
    FlightRecord{recorder, scene, motion, n, piece, 0, radius, piece.a.spin_energy, end}.run();
    return;
  }
  for (int i = 1; i <= n; ++i) {
    piece.t_start = segment.t_start + (i - 1) * piece.duration;
    const double t = i < n ? segment.t_start + i * piece.duration : segment.t_end;
    piece.b = instant_of(scene, block, motion.at(t));
    record_piece(recorder, scene, piece);
    piece.a = piece.b;
  }
}

void flush_passages(PassageRecorder& recorder) {
  for (std::size_t block = 0; block < recorder.trackers.size(); ++block)
    flush(recorder.table, static_cast<int>(block), recorder.trackers[block]);
}

}  // namespace talus
