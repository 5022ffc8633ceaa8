// The step of an island as a page: its nine stages in order (see step/island/stages.hpp).
#include "step/island/step_island.hpp"

#include <algorithm>
#include <cmath>

#include "solver/law_numbers.hpp"
#include "step/accuracy.hpp"
#include "step/island/stages.hpp"
#include "step/mass/stages.hpp"
#include "step/mass/step_mass.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

// Stages 4 to 8: an attempt at the substep of `h` from `t`. Changes nothing but scratch.
SubstepVerdict try_substep(const Scene& scene, const State& state, const PairSearch& search,
                           double t, double h, std::vector<NearFeatures>& near_ground,
                           IslandScratch& w, Solution& solution) {
  {
    const StageTimer timer(w.clock, IslandStage::predict);
    predict(scene, state, w.members, t, h, w.free, w.system.island);
  }
  {
    const StageTimer timer(w.clock, IslandStage::make_contacts);
    if (!make_contacts(scene, state, search, w.manifolds, w.members, w.free, w.tries, near_ground,
                       w.making, w.system))
      return SubstepVerdict::left();
  }
  if (const double touch = first_touch(scene, state, w.system, h); touch < h)
    return SubstepVerdict::again(SubstepCut::yielding_touched, touch);
  // find_hits, solve: in turn
  solve_with_hits(scene, state, search, w.members, near_ground, w.making, w.free, w.system, w.hits,
                  w.solver, w.clock, solution);
  const StageTimer timer(w.clock, IslandStage::check_substep);
  return check_substep(scene, state, search, w.members, w.free, w.system, w.hits,
                       solution.converged, w.tries, near_ground, w.making, w.end);
}

void begin_substep(SubstepRetries& tries) {
  tries.halvings = tries.used_up_cuts = 0;
  tries.broken.clear();
}

// Notes why a substep is made again.
void note_cut(SubstepCut reason, const SubstepEnd& end, const IslandMembers& members,
              SubstepRetries& tries) {
  switch (reason) {
    case SubstepCut::yielding_touched:
      break;
    case SubstepCut::unconverged:
      if (can_ease(members, tries)) {
        ++tries.eased;
      } else {
        tries.eased = law::most_eased;
        ++tries.halvings;
      }
      break;
    case SubstepCut::inaccurate:
      break;
    case SubstepCut::deep:
      ++tries.deep_cuts;
      break;
    case SubstepCut::bond_broken:
      for (const BondFace& face : end.bond_faces)
        if (!holds(face)) tries.broken.push_back(face);
      break;
    case SubstepCut::woken:
      break;
    case SubstepCut::yielding_used_up:
      ++tries.used_up_cuts;
      break;
    case SubstepCut::hit:
      ++tries.hits;
      break;
  }
}

// How far the next substep may go by the error of this one.
void note_accuracy(const Scene& scene, double h, double error, SubstepRetries& tries,
                   StepReport& report) {
  report.largest_error = std::max(report.largest_error, error);
  tries.last_h = h;
  tries.longest = longest_after(scene.settings, error, h, tries.longest);
}

// Stages 4 to 9: attempts from `t`, the first over `h`, until one holds, a member is found off the
// known ground, or one wakes.
void make_substep(const Scene& scene, double t, double h, State& state, Work& work,
                  StepReport& report) {
  IslandScratch& w = work.island;
  begin_substep(w.tries);
  for (;;) {
    Solution solution;
    const SubstepVerdict verdict =
        try_substep(scene, state, work.search, t, h, work.near_ground, w, solution);
    report.passes += solution.passes;
    if (verdict.kind == SubstepVerdict::Kind::left) return;
    if (verdict.kind == SubstepVerdict::Kind::accept) {
      const StageTimer timer(w.clock, IslandStage::accept);
      note_accuracy(scene, h, w.end.error, w.tries, report);
      accept(scene, w.members, w.free, w.system, w.hits, solution.converged, w.tries, w.end, state,
             work.segments, work.deep, report);
      return;
    }
    ++report.cuts[static_cast<size_t>(verdict.reason)];
    state.counters.cut_back += verdict.reason == SubstepCut::unconverged;
    note_cut(verdict.reason, w.end, w.members, w.tries);
    if (verdict.reason == SubstepCut::unconverged)
      choose_stiffness(scene, state, work.search, w.manifolds, w.tries.eased, w.members);
    if (verdict.reason == SubstepCut::woken) return;
    h = verdict.h;
    if (verdict.reason == SubstepCut::inaccurate) w.tries.longest = h;
  }
}

// Stops the members that left the known ground; those that stay, and whose numbers did not fail,
// continue.
void stop_outsiders(const Scene& scene, double t_end, State& state, Work& work,
                    StepReport& report) {
  IslandMembers& members = work.island.members;
  const auto is_outside = [&](int b) {
    return b == work.island.system.outsider || !takes_part(state, b) ||
           left_ground(scene, state.motion[b].pose.position);
  };
  if (std::none_of(members.blocks.begin(), members.blocks.end(), is_outside)) return;
  std::vector<int> stay;
  for (const int b : members.blocks) {
    if (!is_outside(b)) {
      stay.push_back(b);
      continue;
    }
    if (takes_part(state, b)) stop_outside(scene, b, state, report);
    state.local_time[b] = t_end;
  }
  release_members(members);
  gather_members(scene, stay, members);
  let_stand(state, t_end, members);
  work.search.is_of_step = false;
}

// Stages 2 and 3, for at most `ahead`: the longest substep that they allow.
double prepare_substep(const Scene& scene, int k, bool is_mass, double t, double ahead,
                       State& state, Work& work) {
  PairSearch& search = work.search;
  IslandScratch& w = work.island;
  const bool begins = t == state.time;
  {
    const StageTimer timer(w.clock, IslandStage::find_pairs);
    if (search.is_of_step && begins) {
      place_own_fixed(scene, w.members.blocks[0], state, search);
      take_pairs(scene, state, search, k, w.members, w.manifolds);
    } else {
      find_pairs(scene, ahead, state, search, w.members, w.manifolds);
    }
  }
  const StageTimer timer(w.clock, IslandStage::choose_stiffness);
  if (is_mass) return longest_mass_substep(scene, search, w.members, w.manifolds, ahead);
  if (begins) classify_size(scene, state, search, w.manifolds, w.members);
  choose_stiffness(scene, state, search, w.manifolds, w.tries.eased, w.members);
  locate_hits(scene, state, w.tries, w.members);
  return longest_substep(scene, state, search, w.members, w.manifolds, ahead);
}

// Frees the memory of the exact step of a large island: several times the need of its mass step.
void release_exact_step(IslandScratch& w) {
  constexpr size_t large = 1000;  // members
  if (w.members.size() < large) return;
  Workers* const workers = w.solver.matrix.workers;
  w.system = {};
  w.hits = {};
  w.solver = {};
  w.end = {};
  w.solver.matrix.workers = w.hits.impact.workers = workers;
}

}  // namespace

void advance_island(const Scene& scene, int k, double t_end, State& state, Work& work,
                    StepReport& report) {
  IslandScratch& w = work.island;
  {
    const StageTimer timer(w.clock, IslandStage::gather_members);
    gather_members(scene, blocks_of(work.search.groups, k), w.members);
    let_stand(state, t_end, w.members);
  }
  w.end.presses.clear();
  w.tries.deep_cuts = w.tries.eased = w.tries.hits = 0;
  const double dt = (t_end - state.time) / static_cast<double>(state.stride);
  w.tries.last_h = dt;
  w.tries.planned = 0;
  w.tries.longest = no_normal_limit;
  double t = state.time, ahead = t_end - t;
  const bool was_mass = is_any_in_mass(w.members, state);
  bool is_mass = t > 0 && moves_as_mass(scene, w.members, state);
  if (was_mass && !is_mass) work.search.is_of_step = false;  // points that do not close are missing
  if (is_mass && !was_mass) release_exact_step(w);
  while (t < t_end && !w.members.moving.empty()) {
    w.end.sleep.blocks.clear();
    const double longest = prepare_substep(scene, k, is_mass, t, ahead, state, work);
    const bool is_tried = t == 0 && begins_as_mass(scene, longest, state, work);
    if (is_tried) is_mass = true;
    if (is_mass) {
      make_mass_substep(scene, t, longest, is_tried, state, work, report);
      is_mass = is_any_in_mass(w.members, state);
      if (!is_mass) work.search.is_of_step = false;
    } else {
      make_substep(scene, t, std::min({longest, w.tries.longest, dt}), state, work, report);
    }
    if (!w.end.sleep.blocks.empty()) {
      wake_members(scene, t, w.end.sleep, state, w.members);
      work.search.is_of_step = false;
    }
    t = state.local_time[w.members.moving.front()];
    if (t_end - t < 1e-9 * scene.settings.dt) t = t_end;
    stop_outsiders(scene, t_end, state, work, report);
    // pairs that are far apart when a long step begins cost the most, and carry nothing yet
    ahead = (t_end - t) / std::ceil((t_end - t) / (law::substeps_ahead * longest));
  }
  for (const int b : w.members.moving) state.local_time[b] = t_end;
  release_members(w.members);
  place_own_fixed(scene, -1, state, work.search);
}

}  // namespace talus
