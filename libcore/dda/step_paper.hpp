// libcore/dda/step_paper.hpp
// Law paper for one block: penalty springs, open-close iteration, Newmark beta = 1/2, gamma = 1.
// paper: Zhang et al. 2018, Fig. 4, Fig. 8, Eq. (3), (8)-(24), (28), with the slips of theory 1.1
// mended
//
// The patterns are judged on states alone, as printed: when no contact switches, the step is done,
// and the friction of a slipping contact is that of the pass before. At most six passes; the step
// is fixed, so what has not settled by then is accepted and counted. The spin vector is carried as
// in classic DDA, without the gyroscopic term.
#pragma once

#include "dda/report.hpp"
#include "dda/scene.hpp"
#include "dda/state.hpp"
#include "dda/work.hpp"

namespace talus {

/// Moves block b by one step of settings.dt.
void advance_block_paper(const Scene& scene, int b, State& state, Work& work, StepReport& report);

}  // namespace talus
