// libcore/dda/step_talus.hpp
// Law talus for one block: prediction, contact rows, semismooth Newton, impacts at their time, flight.
// theory 1.10 (correction about the free motion), 1.12 (impacts); docs/design-notes.md
#pragma once

#include "dda/report.hpp"
#include "dda/scene.hpp"
#include "dda/state.hpp"
#include "dda/work.hpp"

namespace talus {

/// Moves block b from its local time to `t_end` in as many substeps as events and convergence ask for.
void advance_block_talus(const Scene& scene, int b, double t_end, State& state, Work& work,
                         StepReport& report);

/// Lets block b, at rest, down into static equilibrium with the ground, sticking everywhere.
void settle_block(const Scene& scene, int b, State& state, Work& work);

/// Contact stiffness of block b: the scene's k_n, at most 100 m / dt^2 [N/m]. Beyond that a stiffer
/// spring changes nothing within a step and only costs digits.
[[nodiscard]] double contact_stiffness(const Scene& scene, int b);

}  // namespace talus
