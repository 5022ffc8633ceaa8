// Passages of a flight, in pieces of which only those that matter are followed.
#include "record/passage_flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/scene.hpp"

namespace talus {
namespace {

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
  const Vec2 centre = place_in_plan(motion);
  return {true, {motion, high.z(), spin_energy}, centre + low.head<2>(), centre + high.head<2>()};
}

// Height of a centroid above the plane of the one triangle that some pieces lie over.
struct HeightAbovePlane {
  bool known = false;
  int from = 0;  // piece at which x is 0
  double height = 0, rate = 0, curve = 0;

  [[nodiscard]] double at(double x) const { return height + x * (rate + x * curve); }
  [[nodiscard]] double highest(double low, double high) const {
    const double largest = std::max(at(low), at(high)), peak = -rate / (2 * curve);
    return curve < 0 && peak > low && peak < high ? std::max(largest, at(peak)) : largest;
  }
};

// The pieces of one flight. Where the block is followed piece by piece and where not depends on
// the quantities that can change: cells only near their sides, and the largest height of the top
// only where its centroid is nearly as high as it gets.
struct FlightRecord {
  PassageRecorder& recorder;
  const Scene& scene;
  SegmentMotion& motion;
  int n = 1;             // pieces
  PassagePiece piece{};  // the one at hand; sag, sagitta, turn and duration are those of all
  int n_pending = 0;     // pieces before this are in the tracker's pending values
  double top_bound = 0;  // no vertex is higher above the centroid [m]
  double spin_energy_start = 0, spin_energy_end = 0;  // [J]
  HeightAbovePlane above{};                           // in the pieces whose top is raised

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
    FlightInstant& found = recorder.flight_instants[k];
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

  // Largest height of the centroid in some of the pieces that see_plane() was called for.
  [[nodiscard]] double highest_of_some(int from, int to) const {
    return above.known ? above.highest(from - above.from, to - above.from) : highest(from, to);
  }

  void see_plane(int from, int to) {
    above.known = false;
    const Trn& trn = scene.ground.trn;
    const Vec3 start = position_at(from), end = position_at(to);
    if (to - from == 1 || !segment().acceleration.head<2>().isZero(0) ||
        !contains(trn, start.x(), start.y()) || !contains(trn, end.x(), end.y()))
      return;
    const int triangle = triangle_at(trn, start.x(), start.y());
    if (triangle_at(trn, end.x(), end.y()) != triangle) return;
    const GridPoint at = locate(trn, start.x(), start.y());
    const Vec2 gradient = triangle_gradient(trn, at.cell, is_upper(at));
    const Vec3 off = start - node_point(trn, at.cell.row, at.cell.col),
               path = piece.duration * velocity_at(from);
    above = {true, from, off.z() - gradient.dot(off.head<2>()),
             path.z() - gradient.dot(path.head<2>()),
             0.5 * segment().acceleration.z() * piece.duration * piece.duration};
  }

  // Raises the top's height by that in some pieces, in which the centroid comes as high as
  // `centroid`: in halves, the higher one first, as long as the top may come higher than it has.
  void raise_top(int from, int to, double centroid) {
    float& top = tracker().pending.top_height;
    if (std::isnan(centroid) || static_cast<float>(centroid + top_bound) <= top) return;
    if (to - from == 1) {
      HeightPath whole = path(from, to);
      whole.top_from = instant_at(from).instant.top;
      whole.top_to = instant_at(to).instant.top;
      const auto height = static_cast<float>(largest_heights(scene.ground.trn, whole, 0, 1).top);
      if (!(height <= top)) top = height;
      return;
    }
    const int middle = (from + to) / 2;
    const double before = highest_of_some(from, middle), after = highest_of_some(middle, to);
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
    see_plane(n_pending, k);
    raise_top(n_pending, k, centroid);
    n_pending = k;
  }
  [[nodiscard]] Vec3 velocity_at(int k) const {
    if (k == 0 || k == n) return (k == 0 ? segment().start : segment().end).velocity;
    return segment().start.velocity + k * piece.duration * segment().acceleration;
  }

  // The last piece up to which balls tell that the covered cells stay: one around the block that
  // stays in `outer`, one in it that reaches beyond both sides of `inner`.
  [[nodiscard]] int end_in_cells(int k, const CoveredStrip& strip) const {
    if (!strip.is_strip || !segment().acceleration.head<2>().isZero(0)) return k;
    if (recorder.by_centroid && tracker().covered.size() > 1) return k;
    const double around = recorder.by_centroid ? 0 : scene.blocks.shapes.radius[piece.block];
    const double within = recorder.by_centroid ? 0 : recorder.inner_radius[piece.block];
    const Vec2 at = position_at(k).head<2>(), velocity = segment().start.velocity.head<2>();
    double longest = (n - k) * piece.duration;
    for (int axis = 0; axis < 2; ++axis) {
      const double low = std::min(at[axis] - around - strip.outer.low[axis],
                                  at[axis] + within - strip.inner.high[axis]);
      const double high = std::min(strip.outer.high[axis] - around - at[axis],
                                   strip.inner.low[axis] + within - at[axis]);
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
      k = end_in_cells(k, strip);
      if (k == n) break;
      if (!stays(k, strip)) {
        raise_pending(k);
        piece.t_start = time_at(k);
        piece.a = instant_at(k).instant;
        piece.b = instant_at(k + 1).instant;
        move_tracker(tracker(), piece.a, piece.t_start);
        record_change(recorder, scene, piece);
        move_tracker(tracker(), piece.b, time_at(k + 1));
        n_pending = k + 1;
        strip = strip_of(recorder.grid, tracker().covered);
      }
      ++k;
    }
    raise_pending(n);
    move_tracker(tracker(), instant_at(n).instant, segment().t_end);
    tracker().margin = 0;
  }
};

}  // namespace

void record_flight(PassageRecorder& recorder, const Scene& scene, SegmentMotion& motion,
                   const PassagePiece& piece, int n) {
  const double radius = scene.blocks.shapes.radius[piece.block];
  const double end = rotational_energy(motion.segment().end, scene.blocks.inertia[piece.block]);
  FlightRecord{recorder, scene, motion, n, piece, 0, radius, piece.a.spin_energy, end}.run();
}

}  // namespace talus
