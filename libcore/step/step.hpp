// libcore/step/step.hpp: public
// One time step of all blocks: near cells, entrances, contact law, solution, update (Fig. 4).
// in:    Scene (const), State, Work (scratch)
// out:   State at the end of the step; the motion in between as segments in Work
// paper: Zhang et al. 2018, Fig. 4; theory 1.7-1.12
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/flight.hpp"  // motion_at()
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

/// State at time 0. With Settings::static_start, a block at rest that touches the ground is let
/// down into equilibrium with it (its weight over the contact stiffness, micrometres), with `work`
/// of make_work().
[[nodiscard]] State start(const Scene& scene, Work& work);
[[nodiscard]] State start(const Scene& scene);

/// Buffers for `scene`, large enough that step() does not allocate. `workers` share its loops and
/// outlive it; the bits are the same with any number of them, and without.
[[nodiscard]] Work make_work(const Scene& scene, Workers* workers = nullptr);

/// Advances all blocks by State::stride nominal steps: settings.dt, or twice that while most of the
/// moving mass is in masses.
///
/// A block in flight is not touched until its flight ends: its motion is that at local_time;
/// motion_at() gives it at any time. A block that leaves the known terrain is stopped there.
StepReport step(const Scene& scene, State& state, Work& work);

// For another law (paper/paper_step.hpp), which moves the blocks of the same State.

/// State at time 0 without static start.
[[nodiscard]] State start_unsettled(const Scene& scene);
/// Ends a step after the motion of the blocks over settings.dt: time, breakage, deep blocks,
/// counters.
void end_step(const Scene& scene, State& state, Work& work, StepReport& report);

/// Energies of all blocks at state.time [J]. Potential energy counts from the local zero.
struct Energies {
  double translation = 0, rotation = 0, potential = 0, elastic = 0;
};
[[nodiscard]] Energies energies(const Scene& scene, const State& state);

}  // namespace talus
