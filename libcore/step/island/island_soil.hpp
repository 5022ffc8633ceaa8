// libcore/step/island/island_soil.hpp
// The terms of yielding ground (step/soil.hpp), and of friction between blocks that follows the
// speed, over a substep of an island. Nothing is done where no class asks for it.
#pragma once

#include <span>

#include "step/island/data.hpp"
#include "step/soil.hpp"

namespace talus {

/// Stage 7: friction of the contacts that slip, over the substep as it was solved; whether there
/// is any that varies.
bool renew_friction(const Scene& scene, const State& state, const PairSearch& search,
                    const IslandMembers& members, const FreeMotions& free, const SubstepHits& hits,
                    IslandSystem& system);

/// Stage 9: work of couples, and the distances that members have slid.
void end_soil(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
              const IslandSystem& system, const SubstepHits& hits, State& state);
/// ... and whether the ground presses member k at the end.
[[nodiscard]] bool is_pressed(const IslandSystem& system, std::size_t k);

}  // namespace talus
