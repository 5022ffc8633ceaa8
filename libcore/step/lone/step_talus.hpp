// libcore/step/lone/step_talus.hpp
// Law talus for one block: prediction, contact rows, semismooth Newton, impacts at their time,
// flight. theory 1.10 (correction about the free motion), 1.12 (impacts);
// docs/developing/design-notes.md
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

/// Moves block b from its local time to `t_end` in as many substeps as events and convergence ask
/// for.
void advance_block_talus(const Scene& scene, int b, double t_end, State& state, Work& work,
                         StepReport& report);

}  // namespace talus
