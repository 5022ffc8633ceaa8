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

/// Whether blocks that stay in place are left out until something wakes them.
[[nodiscard]] inline bool may_sleep(const Scene& scene) {
  return scene.settings.sleep && !shakes(scene.base);
}

/// Moves block b until `t_end` as if nothing were there but the ground, in as many substeps as
/// events and convergence ask for, and puts it to sleep where it has stayed in place long enough.
void advance_lone(const Scene& scene, int b, double t_end, State& state, Work& work,
                  StepReport& report);

}  // namespace talus
