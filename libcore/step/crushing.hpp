// libcore/step/crushing.hpp
// Small blocks that are crushed by the load that is pressed through them: a splinter in a jam.
// in:    impulses of the contacts of accepted substeps
// out:   State::load, State::crushed, and at the end of a step the phase of crushed blocks
//
// Load: M = sum N n n^T over the contacts of a block (N normal force), R the sum of their forces.
// Along a principal axis d of M, M_dd is the load from both sides and |R_d| the difference of the
// two sides: half the difference goes through the block. Both are means over law::load_time, and
// hits count with their impulse: no number of steps enters.
#pragma once

#include <cmath>
#include <cstddef>

#include "scene/scene.hpp"
#include "scene/state.hpp"

namespace talus {

/// Adds a contact of block b, with a normal impulse p_n >= 0 along the unit normal and `impulse` in
/// all [N s], to its loads of the step. Blocks that sleep, or that nothing crushes, take no note.
inline void add_load(const Scene& scene, int b, const Vec3& normal, double p_n, const Vec3& impulse,
                     State& state) {
  if (b < 0 || std::isinf(scene.crush_load[b]) || does_not_move(state.phase[b])) return;
  BlockLoad& load = state.load[static_cast<std::size_t>(b)];
  load.step_press += p_n * normal * normal.transpose();
  load.step_push += impulse;
}

/// The largest load that goes through a block [N].
[[nodiscard]] double load_through(const BlockLoad& load);

/// Ends a step that has come to state.time: brings the loads up to date, and crushes the blocks
/// that are loaded beyond their strength. A crushed block carries nothing any more and stays in
/// place; its kinetic energy is booked.
void crush_blocks(const Scene& scene, State& state);

}  // namespace talus
