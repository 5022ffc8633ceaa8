// libcore/step/numerical_faults.hpp
// Which block first went wrong, when and where: the blocks that the limits of a run's health name.
// in:    report of a step, motion at its end
// out:   State::numerical_faults, but the deepest overlap, which step/deep_blocks.hpp notes
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"

namespace talus {

/// Of the step that has just ended at state.time.
void note_numerical_faults(const Scene& scene, const StepReport& report, State& state);

}  // namespace talus
