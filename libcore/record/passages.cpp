// Which cells each block passed and how, from the solver's segments.
#include "record/passages.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "record/passage_flight.hpp"
#include "record/passage_piece.hpp"
#include "scene/scene.hpp"

namespace talus {
namespace {

constexpr double largest_turn = 0.25;  // of a piece [rad]

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

// Angle between two attitudes, from above: theta = 4 asin(d / 2) <= 2.1 d for d <= 0.9.
double turn_bound(const Quat& a, const Quat& b) {
  const double same = (a.coeffs() - b.coeffs()).norm(), other = (a.coeffs() + b.coeffs()).norm();
  return 2.1 * std::min(same, other);
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

// Of the largest ball about the centroid in one of the block's parts.
double inner_radius(const Shapes& shapes, int block) {
  double largest = 0;
  for (int part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part) {
    double radius = shapes.radius[block];
    for (int f = shapes.face_begin[part]; f < shapes.face_begin[part + 1]; ++f)
      radius = std::min(radius, shapes.faces[f].offset);
    for (int w = shapes.wall_begin[part]; w < shapes.wall_begin[part + 1]; ++w)
      radius = std::min(radius, shapes.walls[w].offset);
    largest = std::max(largest, radius);
  }
  return largest;
}

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
  recorder.trackers.resize(n_blocks(scene));
  for (int b = 0; b < n_blocks(scene); ++b)
    recorder.inner_radius.push_back(inner_radius(scene.blocks.shapes, b));
  recorder.last_extents.resize(n_blocks(scene));
  return recorder;
}

void record_start(PassageRecorder& recorder, const Scene& scene, int block, const Motion& motion,
                  double time) {
  const PassageInstant instant = instant_of(scene, block, motion);
  PassageTracker& tracker = recorder.trackers[block];
  tracker.last = instant;
  tracker.last_time = time;
  tracker.start_z = motion.pose.position.z();
  PassagePiece still;
  still.block = block;
  still.a = still.b = instant;
  still.t_start = time;
  cover_end(recorder, scene, still);
  flush_pending(recorder.table, block, tracker);
}

void record_passages(PassageRecorder& recorder, const Scene& scene, SegmentMotion& motion) {
  const Segment& segment = motion.segment();
  const int block = segment.block;
  const double turn = turn_of(segment, scene.blocks.inertia[block]);
  const int n = n_pieces(segment, turn, recorder.grid.cell_size);
  const double radius = scene.blocks.shapes.radius[block];
  PassageTracker& tracker = recorder.trackers[block];
  PassagePiece piece;
  piece.block = block;
  piece.duration = (segment.t_end - segment.t_start) / n;
  piece.sag = 0.5 * segment.acceleration.z() * piece.duration * piece.duration;
  piece.turn = turn / n;
  piece.sagitta = radius * piece.turn * piece.turn / (segment.flight ? 4 : 8);
  piece.a = same_motion(tracker.last.motion, segment.start)
                ? tracker.last
                : instant_of(scene, block, segment.start);
  if (segment.flight) {
    record_flight(recorder, scene, motion, piece, n);
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
    flush_pending(recorder.table, static_cast<int>(block), recorder.trackers[block]);
}

}  // namespace talus
