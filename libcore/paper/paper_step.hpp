// libcore/paper/paper_step.hpp: public
// Law paper: penalty springs, open-close iteration, Newmark beta = 1/2, gamma = 1, for the blocks
// of an island together. It moves the State of the engine in its place, and shares its search,
// bonds, loads and the records of a step. Its own state, work and settings are in PaperLaw.
// paper: Zhang et al. 2018, Fig. 4, Fig. 8, Eq. (3), (8)-(24), (28), with the slips of theory 1.1
// mended
//
// The patterns are judged on states alone, as printed: when no contact switches, the step is done,
// and the friction of a slipping contact is that of the pass before. At most six passes; the step
// is fixed, so a step that has not settled by then is accepted and counted. The spin vector is
// carried as in classic DDA, without the gyroscopic term. Not in the paper: a contact that appears
// already overlapping (features of two blocks change places) has no force at first, and its overlap
// is removed at 0.3 m/s: the work of k_n on it would be energy from nowhere.
#pragma once

#include "paper/paper_state.hpp"
#include "paper/paper_work.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

/// Law paper of one run.
struct PaperLaw {
  PaperSettings settings;
  PaperState state;
  PaperWork work;
};

/// State at time 0: bonds with the ground, no static start. Throws InputError where
/// Settings::normal_stiffness is 0.
[[nodiscard]] State paper_start(const Scene& scene, Work& work, PaperLaw& paper);

/// Advances all blocks to state.time + settings.dt. Eq. (28) is applied only where blocks do not
/// meet: in a mass it throws them about.
StepReport paper_step(const Scene& scene, State& state, Work& work, PaperLaw& paper);

}  // namespace talus
