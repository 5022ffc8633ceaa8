// libcore/scene/worlds.hpp: public
// The world in which a block meets yielding bodies, and their state there.
// in:    a scene, bodies pushed so far (YieldingState)
// out:   the one access to it, whether blocks share a world or have each their own
#pragma once

#include "blocks/rocks_at_a_time.hpp"
#include "scene/scene.hpp"

namespace talus {

/// Whether all blocks share one world: they can meet each other, or there is but one.
[[nodiscard]] inline bool shares_world(const Scene& scene) {
  return scene.settings.block_contacts || n_blocks(scene) == 1;
}

/// Whether `n_rocks` blocks of a scene fall one by one, a few at a time (run/rocks.hpp): none meets
/// another, breaks or carries a load, and there are more than a few.
[[nodiscard]] inline bool fall_a_few_at_a_time(const Scene& scene, int n_rocks) {
  return !scene.settings.block_contacts && scene.fragments.empty() && scene.loads.empty() &&
         n_rocks > rocks_at_a_time + 1;
}

/// The world of block `b`: index into YieldingState::worlds. A piece is in that of its rock.
[[nodiscard]] int world_of(const Scene& scene, int b);

/// State of body `yielding` in a world; that at the start where nothing pushed it.
[[nodiscard]] const Yielded& met_by(const YieldingState& state, int world, int yielding);
/// The same to be changed.
[[nodiscard]] Yielded& meet(YieldingState& state, int world, int yielding);

}  // namespace talus
