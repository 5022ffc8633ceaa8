// libcore/scene/worlds.hpp: public
// In which world a block meets the bodies that give way, and what they have met there.
// in:    a scene, what was pushed so far (YieldingState)
// out:   the one access to it, whether blocks share a world or have each their own
#pragma once

#include "scene/scene.hpp"

namespace talus {

/// Whether all blocks share one world: they can meet each other, or there is but one.
[[nodiscard]] inline bool shares_world(const Scene& scene) {
  return scene.settings.block_contacts || n_blocks(scene) == 1;
}

/// The world of block `b`: index into YieldingState::worlds. A piece is in that of its rock.
[[nodiscard]] int world_of(const Scene& scene, int b);

/// What body `yielding` has met in a world; nothing where nothing pushed it.
[[nodiscard]] const Yielded& met_by(const YieldingState& state, int world, int yielding);
/// The same to be changed.
[[nodiscard]] Yielded& meet(YieldingState& state, int world, int yielding);

}  // namespace talus
