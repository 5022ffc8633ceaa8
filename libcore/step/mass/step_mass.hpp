// libcore/step/mass/step_mass.hpp
// The mass step, for islands of which many blocks move: step/mass/stages.hpp.
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

/// Makes a substep of at most `h` from `t`; pairs are those of work.search, manifolds and members
/// those of work.island. False: nothing was done, since a member is off the known ground
/// (IslandSystem::outsider) or wakes (SubstepEnd::woken), or since the sweeps diverge: the members
/// are in no mass then. `is_tried`: begins_as_mass() has just
/// tried it over the same `h`.
bool make_mass_substep(const Scene& scene, double t, double h, bool is_tried, State& state,
                       Work& work, StepReport& report);

/// Whether an island is a mass from the start of a run, when nothing moves yet and no contact knows
/// its load: tries the first substep, of `h`, with as many sweeps as let support rise
/// through all layers of blocks. Where that settles it asks leaves_as_mass(); else the run begins
/// exact.
[[nodiscard]] bool begins_as_mass(const Scene& scene, double h, State& state, Work& work);

/// Nominal steps that the next step takes at once: two, once most of the moving mass is in masses
/// that such steps follow as well as the accuracy asks for, for law::patience substeps; else one.
[[nodiscard]] int next_stride(const Scene& scene, const State& state);

}  // namespace talus
