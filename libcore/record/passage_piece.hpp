// libcore/record/passage_piece.hpp
// One piece of a block's motion into the table of passages. As long as the covered cells stay, a
// piece only raises the pending values of the block's tracker; where they may change, these go to
// the table and so does each cell that the piece passes.
#pragma once

#include "record/passage_recorder.hpp"

namespace talus {

/// A piece of motion, straight in plan, in which the block turns by less than 0.25 rad.
struct PassagePiece {
  int block = 0;
  PassageInstant a, b;
  double t_start = 0, duration = 0;  ///< [s]
  double sag = 0;                    ///< a_z h^2 / 2 [m]
  double turn = 0;                   ///< the attitude turns by less [rad]
  double sagitta = 0;                ///< of a vertex's path by turning, from above [m]
};

[[nodiscard]] inline Vec2 place_in_plan(const Motion& motion) {
  return motion.pose.position.head<2>();
}

/// The tracker's covered cells at the end of `piece`, and the block's values there as the first of
/// the new set.
void cover_end(PassageRecorder& recorder, const Scene& scene, const PassagePiece& piece);

/// Writes the pending values of the covered cells into the table.
void flush_pending(PassageTable& table, int block, const PassageTracker& tracker);

/// The tracker to the end of a piece, or of several.
void move_tracker(PassageTracker& tracker, const PassageInstant& end, double time);

/// A piece in which the covered cells may change; the tracker's cells and values are then those at
/// its end, its place is still that at the start.
void record_change(PassageRecorder& recorder, const Scene& scene, const PassagePiece& piece);

/// A piece of a step with contact: looks itself whether the covered cells may change.
void record_piece(PassageRecorder& recorder, const Scene& scene, const PassagePiece& piece);

}  // namespace talus
