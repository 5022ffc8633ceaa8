// Adds one piece of a block's motion to the table of passages.
#include "record/passage_piece.hpp"

#include <algorithm>
#include <cmath>

#include "record/footprint_cells.hpp"
#include "scene/scene.hpp"
#include "terrain/trn_walk.hpp"

namespace talus {
namespace {

PassageValues values_between(const Scene& scene, const PassagePiece& piece, double s_in,
                             double s_out) {
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

void widen(Extents& extents, double by) {
  extents.low -= by;
  extents.high += by;
}

// The end of a piece is asked for again as its cells and as the start of the next.
Footprint footprint_of(PassageRecorder& recorder, const Scene& scene, int block,
                       const Motion& motion) {
  LastExtents& last = recorder.last_extents[block];
  const Quat& attitude = motion.pose.attitude;
  if (last.attitude.coeffs() != attitude.coeffs())
    last = {attitude, footprint_extents(scene.blocks.shapes, block, attitude)};
  return {place_in_plan(motion), last.extents};
}

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

// Records the cells of a piece in which the covered cells may change.
void record_sweep(PassageRecorder& recorder, const Scene& scene, const PassagePiece& piece,
                  const PassageValues& whole) {
  const Motion &a = piece.a.motion, &b = piece.b.motion;
  const PassageTracker& tracker = recorder.trackers[piece.block];
  const Vec3 path = b.pose.position - a.pose.position;
  const auto visit = [&](int cell, double s_in, double s_out) {
    const double time = piece.t_start + s_in * piece.duration;
    const PassageValues values =
        s_in <= 0 && s_out >= 1 ? whole : values_between(scene, piece, s_in, s_out);
    if (Passage* known = recorder.table.earlier(piece.block, cell, static_cast<float>(time))) {
      known->largest.raise(values);
      return;
    }
    const double z = a.pose.position.z() + s_in * path.z() - piece.sag * s_in * (1 - s_in);
    Passage row =
        arrival(piece.block, tracker, time, z, tracker.path + s_in * path.head<2>().norm(),
                a.velocity + s_in * (b.velocity - a.velocity));
    row.cell = cell;
    row.largest = values;
    recorder.table.raise(row);
  };
  if (recorder.by_centroid) {
    walk_cells(recorder.frame, place_in_plan(a), place_in_plan(b), [&](const CellPart& part) {
      visit(cell_index(recorder.grid, part.cell.row, part.cell.col), part.t_in, part.t_out);
    });
    return;
  }
  Footprint start = footprint_of(recorder, scene, piece.block, a);
  Footprint end = footprint_of(recorder, scene, piece.block, b);
  widen(start.extents, piece.sagitta);
  widen(end.extents, piece.sagitta);
  sweep_cells(recorder.grid, start, end, visit);
}

}  // namespace

void flush_pending(PassageTable& table, int block, const PassageTracker& tracker) {
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

void cover_end(PassageRecorder& recorder, const Scene& scene, const PassagePiece& piece) {
  PassageTracker& tracker = recorder.trackers[piece.block];
  const Vec2 at = place_in_plan(piece.b.motion);
  if (recorder.by_centroid)
    find_covered(recorder, at, tracker);
  else
    find_covered(recorder.grid, footprint_of(recorder, scene, piece.block, piece.b.motion),
                 tracker);
  tracker.pending = values_between(scene, piece, 1, 1);
}

void move_tracker(PassageTracker& tracker, const PassageInstant& end, double time) {
  tracker.path += (place_in_plan(end.motion) - place_in_plan(tracker.last.motion)).norm();
  tracker.last = end;
  tracker.last_time = time;
}

void record_change(PassageRecorder& recorder, const Scene& scene, const PassagePiece& piece) {
  flush_pending(recorder.table, piece.block, recorder.trackers[piece.block]);
  record_sweep(recorder, scene, piece, values_between(scene, piece, 0, 1));
  cover_end(recorder, scene, piece);
}

void record_piece(PassageRecorder& recorder, const Scene& scene, const PassagePiece& piece) {
  PassageTracker& tracker = recorder.trackers[piece.block];
  const Motion &a = piece.a.motion, &b = piece.b.motion;
  const double moved =
      (place_in_plan(b) - place_in_plan(a)).norm() +
      (recorder.by_centroid ? 0 : scene.blocks.shapes.radius[piece.block] * piece.turn);
  if (moved < tracker.margin || moved == 0) {
    tracker.margin -= moved;
    tracker.pending.raise(values_between(scene, piece, 0, 1));
  } else {
    record_change(recorder, scene, piece);
  }
  move_tracker(tracker, piece.b, piece.t_start + piece.duration);
}

}  // namespace talus
