// libcore/step/island/step_island.hpp: public
// Law talus for blocks within reach of each other: islands, their joint substeps and impacts.
// in:    motion of all blocks; ground and hulls of the scene
// out:   motion and contact memory of the blocks of an island at the end of the step
// theory 1.6, 1.7, 1.10, 1.12, 3.5; docs/developing/design-notes.md
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

/// Groups the blocks into islands for the step from state.time on: work.search.groups.
///
/// Two blocks are joined when parts of theirs are within reach of the step's relative motion. A
/// sleeping block wakes where another block comes within reach.
void form_islands(const Scene& scene, State& state, Work& work);

/// Moves the blocks of island `k`, two or more, from state.time to `t_end` together, in as many
/// substeps as impacts and convergence ask for. Blocks of an island are rigid.
void advance_island(const Scene& scene, int k, double t_end, State& state, Work& work,
                    StepReport& report);

/// Puts the blocks of island `k` to sleep when all have stayed in place long enough.
void put_island_to_sleep(const Scene& scene, int k, State& state, Work& work);

}  // namespace talus
