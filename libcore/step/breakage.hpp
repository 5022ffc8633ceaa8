// libcore/step/breakage.hpp: public
// Blocks that break when they are hit: their pieces, cut before the run (blocks/fragments.hpp),
// take their place.
// in:    normal energy that the hits of a step took from each block
// out:   State::breaks, phases and motion of the pieces, the ledger
//
// A block breaks with the chance 1 - 2^-(E / (G A))^k, E the energy that its hits of the step took,
// G the work of fracture, A the section between its pieces, k the spread. The draw is a hash of
// seed, body and number of its hits. Pieces inherit the motion of the block as it is: momentum,
// angular momentum and energy stay. G A and the energy that drives them apart come out of E.
#pragma once

#include <span>

#include "contact/contact.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/work.hpp"

namespace talus {

/// Adds the normal energy that a contact's hit took from block b to those of the step [J].
inline void add_hit_loss(int b, double loss, State& state) {
  if (b >= 0) state.hit_loss[static_cast<std::size_t>(b)] += loss;
}

/// The same for a hit on the ground, all of whose contacts are solved together: the work of the
/// push along the mean normal at the mean point of `contacts` that approached, at most
/// `dissipated`.
void add_ground_hit_loss(const Scene& scene, int b, const Motion& before, const Motion& after,
                         std::span<const Contact> contacts, double dissipated, State& state);

/// That a section breaks on which `loss` was lost and that takes `work` [J]: 1 - 2^-(loss/work)^k.
[[nodiscard]] double chance_of_breaking(double loss, double work, double spread);

/// The pieces of block b take its place at its motion, which is that at state.time, driven apart by
/// an impulse across the cut that adds `separation` to their energy [J].
void release_pieces(const Scene& scene, int b, double separation, State& state);

/// Ends a step that has come to state.time: blocks that were hit hard enough break, and their
/// pieces, while energy is left.
void break_blocks(const Scene& scene, State& state, Work& work);

}  // namespace talus
