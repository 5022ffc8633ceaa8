// Stage 7 of an island's step, the contact impulses, and the rounds of stages 6 to 8.
#include <algorithm>

#include "solver/law_numbers.hpp"
#include "step/island/stages.hpp"

namespace talus {
namespace {

using std::size_t;

using law::hit_tolerance, law::island_tolerance, law::linear_tolerance, law::most_hit_rounds,
    law::motion_tolerance, law::rest_tolerance, law::small_hit_tolerance, law::small_tolerance;

double fastest(const FreeMotions& free) {
  double speed = 0;
  for (const Substep& s : free.substeps) speed = std::max(speed, s.start.velocity.norm());
  return speed;
}

double fastest_hit(const SubstepHits& hits) {
  double speed = 0;
  for (const Hit& hit : hits.hits) speed = std::max(speed, -hit.speed);
  return speed;
}

}  // namespace

void solve(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
           bool continues, IslandSystem& system, SubstepHits& hits, IslandWork& solver,
           Solution& solution) {
  IslandSettings settings;
  settings.continues = continues;
  settings.down = scene.gravity;
  const double by_gravity = scene.gravity.norm() * free.h;
  settings.tolerance = small_tolerance * by_gravity;
  settings.direct_bodies = members.is_small ? static_cast<int>(members.size()) : 0;
  if (!members.is_small) {
    const double by_motion = std::clamp(motion_tolerance * fastest(free),
                                        rest_tolerance * by_gravity, island_tolerance * by_gravity);
    settings.tolerance = std::max(by_motion, hit_tolerance * fastest_hit(hits));
    // a pile at rest is solved to far below what gravity does: good directions spare it steps
    settings.linear_tolerance = std::clamp(settings.tolerance / by_gravity,
                                           law::linear_tolerance_at_rest, linear_tolerance);
  }
  settings.tolerance *= scene.settings.tolerance_factor;
  const IslandResult solved = solve_island(system.island, settings, solver);
  solution.passes += solved.passes;
  system.is_hard |= !continues && free.t > 0 && solved.passes > law::hard_passes;
  solution.converged = solved.converged;
  for (const int k : solver.touched_bodies.items) hits.moved.add(k);
}

namespace {

// Makes contacts at rest as stiff as the impulses found ask for: whether one was not yet.
bool stiffen_to_load(const IslandMembers& members, double h, IslandSystem& system) {
  bool any = false;
  for (size_t r = 0; r < system.contacts.size(); ++r) {
    const KeptContact& contact = system.contacts[r];
    const RowIn<RowGroup> lane = lane_of(system, r);
    if (contact.hit >= 0 || contact.waits || contact.bond_area != 0 || gives_way(system, r))
      continue;
    const BlockNumbers& a = members.of(contact.a);
    double sag = a.sag, most = a.most_stiffness;
    if (contact.b >= 0) {
      const BlockNumbers& b = members.of(contact.b);
      sag = std::min(sag, b.sag), most = std::min(most, b.most_stiffness);
    }
    const double per_stiffness = h * a.recovery_time, damping = lane.normal_damping();
    const double needed = lane.normal_impulse() / h / sag * per_stiffness;
    const double next = std::min(law::ample_at_start * needed, most * per_stiffness);
    if (!(sag > 0) || needed <= damping || next <= damping) continue;
    lane.set(&RowGroup::normal_damping, next);
    lane.set(&RowGroup::shear_damping, next / damping * lane.shear_damping());
    note_change(system, r);
    any = true;
  }
  return any;
}

}  // namespace

// Gives up where first_lone_hit() says that the substep ends sooner: check_substep() sees that.
void solve_with_hits(const Scene& scene, const State& state, const IslandMembers& members,
                     const FreeMotions& free, const SubstepTries& tries, IslandSystem& system,
                     SubstepHits& hits, IslandWork& solver, Rebounds& rebounds, StageClock* clock,
                     Solution& solution) {
  const double h = free.h;
  const auto solve_on = [&](bool continues) {
    const StageTimer timer(clock, IslandStage::solve);
    solve(scene, members, free, continues, system, hits, solver, solution);
    return solution.converged;
  };
  const auto ends_sooner = [&] { return first_lone_hit(members, tries, hits, h) < h; };
  {
    const StageTimer timer(clock, IslandStage::find_hits);
    find_first_hits(state, members, free, system, hits);
    if (ends_sooner()) return;
    set_times(free, members, true, system, hits);
  }
  rebounds.expected.clear();
  const double tolerance = members.is_small ? small_hit_tolerance : hit_tolerance;
  solve_on(false);
  // at the start nobody knows what contacts bear
  for (int i = 0; i < law::most_settlings && free.t == 0 && solution.converged; ++i)
    if (!stiffen_to_load(members, h, system) || !solve_on(true)) break;
  for (int round = 0; round < most_hit_rounds && solution.converged; ++round) {
    if (round == 0 && bear_by_opened(state, members, free, system, hits) && !solve_on(true)) break;
    const StageTimer timer(clock, IslandStage::rebound);
    const int n_more = find_more_hits(members, free, system, hits);
    if (hits.hits.empty() || ends_sooner()) return;
    set_targets(members, free, system, hits, rebounds);
    const double error = correct_hits(hits, system, rebounds);
    if (n_more > 0) set_times(free, members, false, system, hits);
    if (n_more == 0 && error <= tolerance) break;
    solve_on(true);
  }
  if (!solution.converged || !gain_energy(members, system, hits)) return;
  const double excess = forgo_rebound(members, system, hits, rebounds);
  if (solve_on(true) && correct_hits(hits, system, rebounds) > tolerance) solve_on(true);
  blend_rebound(members, excess, hits, rebounds, system);
}

}  // namespace talus
