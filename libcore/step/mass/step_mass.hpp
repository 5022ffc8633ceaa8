// libcore/step/mass/step_mass.hpp
// The mass step, for islands of which many blocks move: step/mass/stages.hpp.
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

/// Makes a substep of at most `h` from `t`; pairs are those of work.search, manifolds and members
/// those of work.island. False: nothing was done, a member is off the known ground
/// (IslandSystem::outsider).
bool make_mass_substep(const Scene& scene, double t, double h, State& state, Work& work,
                       StepReport& report);

/// At the start of a run: makes the first substep of `h` with most sweeps, for leaves_as_mass().
/// Nothing of the substep is kept.
[[nodiscard]] bool begins_as_mass(const Scene& scene, double h, State& state, Work& work);

}  // namespace talus
