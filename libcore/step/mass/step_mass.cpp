// The mass step as a page: its stages in order (see step/mass/stages.hpp).
#include "step/mass/step_mass.hpp"

#include <algorithm>

#include "scene/yielding.hpp"
#include "solver/law_numbers.hpp"
#include "solver/mass_numbers.hpp"
#include "step/island/stages.hpp"
#include "step/mass/stages.hpp"

namespace talus {
namespace {

MassSettings settings_of(const Scene& scene, const MassShare& share, double h, Workers* workers) {
  MassSettings settings;
  settings.sweeps = mass_sweeps(scene.settings.accuracy);
  settings.most_sweeps = std::max(settings.sweeps, 8 * mass::sweeps);
  settings.settled = settled_change(scene, h);
  settings.compliance = mass_compliance(scene, share);
  settings.shear_ratio = scene.settings.shear_ratio;
  settings.workers = workers;
  return settings;
}

// Overlap is pressed out over law::recovery_steps, long ones too: faster, the support of layers
// rings.
void set_recovery_time(const Scene& scene, double h, IslandMembers& members) {
  const double recovery_time =
      law::recovery_steps * (is_long_step(scene, h) ? h : scene.settings.dt);
  for (BlockNumbers& c : members.numbers) c.recovery_time = recovery_time;
}

// Stages 1 and 2. False: a member is off the known ground.
bool predict_contacts(const Scene& scene, double t, double h, const State& state, Work& work) {
  IslandScratch& island = work.island;
  {
    const StageTimer timer(island.clock, IslandStage::predict);
    predict_free(scene, state, island.members, t, h, work.workers, island.free);
  }
  const StageTimer timer(island.clock, IslandStage::make_contacts);
  return make_mass_contacts(scene, state, work.search, island.manifolds, island.members,
                            island.free, work.near_ground, work.workers, work.mass,
                            island.system.outsider);
}

// Stages 3 and 4.
void solve_mass_contacts(const Scene& scene, const MassSettings& settings, const State& state,
                         Work& work) {
  IslandScratch& island = work.island;
  MassScratch& w = work.mass;
  {
    const StageTimer timer(island.clock, IslandStage::solve);
    w.solved = solve_mass(settings, w.system, widest_mass_lanes());
  }
  const StageTimer timer(island.clock, IslandStage::accept);
  find_mass_changes(scene, state, work.search, island.members, island.free, w);
}

// Whether members asleep have to be awake in the substep of `h`.
bool wakes_any(const Scene& scene, double h, const State& state, Work& work) {
  SubstepEnd& end = work.island.end;
  end.presses.clear();
  end.sleep.blocks.clear();
  if (!asks_for_presses(state, work.island.members)) return false;
  const IslandMembers& members = work.island.members;
  list_presses(members, h, work.mass, end.presses);
  for (std::size_t k = 0; k < members.size(); ++k)
    if (work.mass.changes[k].was_hit && phase_of(state, members.blocks[k]) == Phase::asleep)
      end.sleep.blocks.push_back(members.blocks[k]);
  add_piles(state, end.sleep);
  find_woken(scene, state, members, end);
  return !end.sleep.blocks.empty();
}

}  // namespace

bool make_mass_substep(const Scene& scene, double t, double h, bool is_tried, State& state,
                       Work& work, StepReport& report) {
  IslandScratch& island = work.island;
  MassScratch& w = work.mass;
  island.system.outsider = -1;
  double planned = std::max(h, island.tries.planned);
  for (int cuts = 0;; ++cuts) {
    const MassShare& share = state.mass[island.members.moving.front()];
    set_recovery_time(scene, h, island.members);
    if (!is_tried || cuts > 0) {
      if (!predict_contacts(scene, t, h, state, work)) return false;
      solve_mass_contacts(scene, settings_of(scene, share, h, work.workers), state, work);
    }
    report.passes += w.solved.sweeps;
    if (w.solved.diverges) {
      ++report.cuts[static_cast<std::size_t>(SubstepCut::unconverged)];
      bar_from_mass(scene, island.members, state);
      return false;
    }
    if (is_long_step(scene, h) && w.error > scene.settings.accuracy) {
      ++report.cuts[static_cast<std::size_t>(SubstepCut::inaccurate)];
      h /= 2;
      planned = std::max(h, island.tries.planned);
      continue;
    }
    if (wakes_any(scene, h, state, work)) {
      ++report.cuts[static_cast<std::size_t>(SubstepCut::woken)];
      return false;
    }
    const StageTimer timer(island.clock, IslandStage::accept);
    const double used_up = time_to_first_break(scene, state.yielding, w.pushes, h);
    if (used_up < h && cuts < law::most_repetitions) {
      ++report.cuts[static_cast<std::size_t>(SubstepCut::yielding_used_up)];
      h = used_up;
      island.tries.planned = planned;
      continue;
    }
    accept_mass(scene, island.members, island.free, w, planned, state, work.segments, work.deep,
                report);
    note_solution(scene, island.members, h, w, state, report);
    return true;
  }
}

bool begins_as_mass(const Scene& scene, double h, State& state, Work& work) {
  const IslandMembers& members = work.island.members;
  MassScratch& w = work.mass;
  if (!may_be_mass(scene, members, state) || !predict_contacts(scene, 0, h, state, work))
    return false;
  const int layers = layers_on_ground(w.system);
  MassSettings settings = settings_of(scene, {}, h, work.workers);
  settings.sweeps = mass::sweeps * std::max(8, 2 * layers * layers);
  settings.most_sweeps = mass::most_first_sweeps;
  settings.from_rest = true;
  if (settings.sweeps > settings.most_sweeps) return false;
  solve_mass_contacts(scene, settings, state, work);
  return has_settled(scene, h, w.solved.change) &&
         leaves_as_mass(scene, members, work.island.free, w, state);
}

}  // namespace talus
