// libcore/step/island/island_soil.hpp
// Where ground that gives way (step/soil.hpp) comes in over a substep of an island. Nothing is done
// where no class of ground asks for it.
#pragma once

#include <span>

#include "step/island/data.hpp"
#include "step/soil.hpp"

namespace talus {

/// Stage 4: motion that block b begins the substep with, after drag.
[[nodiscard]] Motion begin_drag(const Scene& scene, const State& state, std::size_t b, double h);

/// Stage 7: friction of the contacts that slip, over the substep as it was solved; whether there
/// is any that varies.
bool renew_friction(const Scene& scene, const State& state, const IslandMembers& members,
                    const FreeMotions& free, const SubstepHits& hits, IslandSystem& system);

/// Stage 9: work of couples, and the ways that members have slid.
void end_soil(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
              const IslandSystem& system, const SubstepHits& hits, State& state);
/// ... and motion of member k, which began the step with `before`, after drag.
[[nodiscard]] Motion end_drag(const Scene& scene, const IslandMembers& members,
                              const FreeMotions& free, const IslandSystem& system, std::size_t k,
                              const Motion& end, const Motion& before, State& state);

/// The same for block b that began the substep of `h` with `start`, its motion before drag being
/// `before`; `is_pressed`: on the ground.
[[nodiscard]] Motion end_drag(const Scene& scene, int b, const Motion& before, const Motion& start,
                              const Motion& end, bool is_pressed, double h, State& state);

}  // namespace talus
