// libcore/step/paper/step_paper.hpp
// Law paper: penalty springs, open-close iteration, Newmark beta = 1/2, gamma = 1, for the blocks
// of an island together. paper: Zhang et al. 2018, Fig. 4, Fig. 8, Eq. (3), (8)-(24), (28), with
// the slips of theory 1.1 mended
//
// The patterns are judged on states alone, as printed: when no contact switches, the step is done,
// and the friction of a slipping contact is that of the pass before. At most six passes; the step
// is fixed, so what has not settled by then is accepted and counted. The spin vector is carried as
// in classic DDA, without the gyroscopic term. Not in the paper: a contact that appears already
// overlapping (features of two blocks change places) presses nothing at first, and its overlap is
// pressed out at 0.3 m/s: the work of k_n on it would be energy from nowhere.
#pragma once

#include <span>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

/// Moves the blocks `members` (ascending) by one step of settings.dt, with the contacts between
/// them of `manifolds`, indices into work.search.pairs sorted by block. Eq. (28) is applied only
/// where blocks do not meet: in a mass it throws them about (docs/evidence/measurements.md).
void advance_island_paper(const Scene& scene, std::span<const int> members,
                          std::span<const int> manifolds, State& state, Work& work,
                          StepReport& report);

}  // namespace talus
