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

#include <algorithm>
#include <cmath>
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

/// Adds the losses of hits; for_each(take) calls take(block a, block b, loss) for each. The ground
/// and fixed bodies (b < 0) have no part in it; two blocks have half of it each. Where a hit is
/// passed on through a block, one contact takes energy that another gives back (loss < 0): together
/// they have the loss of all hits of the substep, so that breaking takes no more.
template <class ForEach>
void add_hit_losses(const ForEach& for_each, State& state) {
  double taken = 0, given = 0;
  for_each([&](int, int, double loss) { (loss > 0 ? taken : given) += std::abs(loss); });
  if (taken <= given) return;
  for_each([&](int a, int b, double found) {
    const double loss = std::max(0.0, found) * (1 - given / taken);
    add_hit_loss(a, b < 0 ? loss : loss / 2, state);
    add_hit_loss(b, loss / 2, state);
  });
}

/// That a section breaks on which `loss` was lost and that takes `work` [J]: 1 - 2^-(loss/work)^k.
[[nodiscard]] double chance_of_breaking(double loss, double work, double spread);

/// The pieces of block b take its place at its motion, which is that at state.time, driven apart by
/// an impulse across the cut that adds `separation` to their energy [J].
void release_pieces(const Scene& scene, int b, double separation, State& state);

/// Ends a step that has come to state.time: blocks that were hit hard enough break, and their
/// pieces, while energy is left.
void break_blocks(const Scene& scene, State& state, Work& work);

}  // namespace talus
