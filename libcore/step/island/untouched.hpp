// libcore/step/island/untouched.hpp
// Blocks of small islands that touch nothing but the ground within the step. A neighbour that is
// not touched changes nothing: such a block moves by the step of a lone block, to the bit, and
// whether it met anything is checked afterwards.
// in:    the islands of form_islands()
// out:   the motion of these blocks at the end of the step; islands of the remaining blocks alone
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

/// Moves the blocks of small islands that touch nothing but the ground until `t_end`, and takes
/// them out of the islands: work.untouched.alone. Ends the flights of the remaining members.
void move_untouched(const Scene& scene, double t_end, State& state, Work& work, StepReport& report);

}  // namespace talus
