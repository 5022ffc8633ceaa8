// Stage 7 of an island's step, the contact impulses, and how stages 6 and 7 follow on each other.
#include <algorithm>

#include "contact/scales.hpp"
#include "solver/law_numbers.hpp"
#include "step/island/island_soil.hpp"
#include "step/island/stages.hpp"

namespace talus {
namespace {

using std::size_t;

using law::island_tolerance, law::relative_tolerance, law::most_rounds_in_substep;

double fastest(const FreeMotions& free) {
  double speed = 0;
  for (const Substep& s : free.substeps) speed = std::max(speed, s.start.velocity.norm());
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
  settings.tolerance = rounding * by_gravity;
  settings.direct_bodies = members.is_small ? static_cast<int>(members.size()) : 0;
  if (!members.is_small) {
    settings.tolerance = std::clamp(relative_tolerance * fastest(free), negligible * by_gravity,
                                    island_tolerance * by_gravity);
    // a pile at rest is solved to far below the effect of gravity: good directions spare it steps
    settings.linear_tolerance =
        std::clamp(settings.tolerance / by_gravity, law::relative_tolerance, island_tolerance);
  }
  settings.tolerance *= scene.settings.tolerance_factor;
  const IslandResult solved = solve_island(system.island, settings, solver);
  solution.passes += solved.passes;
  system.converges_slowly |= !continues && free.t > 0 && solved.passes > law::hard_passes;
  solution.converged = solved.converged;
  for (const int k : solver.touched_bodies.items) hits.moved.add(k);
}

namespace {

// Makes contacts at rest as stiff as the impulses found ask for: whether one was not yet.
bool stiffen_to_load(const IslandMembers& members, double h, IslandSystem& system) {
  bool any = false;
  for (size_t r = 0; r < system.contacts.size(); ++r) {
    const KeptContact& contact = system.contacts[r];
    const IslandRow row = row_of(system, r);
    if (contact.is_hit() || contact.waits || contact.bond_area != 0 || gives_way(system, r))
      continue;
    const BlockNumbers& a = members.of(contact.a);
    double sag = a.sag, most = a.most_stiffness;
    if (contact.b >= 0) {
      const BlockNumbers& b = members.of(contact.b);
      sag = std::min(sag, b.sag), most = std::min(most, b.most_stiffness);
    }
    const double per_stiffness = h * a.recovery_time, damping = row.normal_damping();
    const double needed = row.normal_impulse() / h / sag * per_stiffness;
    const double next = std::min(law::ample_at_start * needed, most * per_stiffness);
    if (!(sag > 0) || needed <= damping || next <= damping) continue;
    row.set_damping(next, next / damping * row.shear_damping());
    note_change(system, r);
    any = true;
  }
  return any;
}

}  // namespace

void solve_with_hits(const Scene& scene, const State& state, const PairSearch& search,
                     const IslandMembers& members, std::vector<NearFeatures>& near_ground,
                     ContactMaking& making, FreeMotions& free, IslandSystem& system,
                     SubstepHits& hits, IslandWork& solver, StageClock* clock, Solution& solution) {
  {
    const StageTimer timer(clock, IslandStage::find_hits);
    find_hits(scene, state, search, members, near_ground, making, free, system, hits);
    solution.passes += hits.passes;
  }
  const auto solve_on = [&](bool continues) {
    const StageTimer timer(clock, IslandStage::solve);
    solve(scene, members, free, continues, system, hits, solver, solution);
    return solution.converged;
  };
  for (int round = 0; round < most_rounds_in_substep; ++round) {
    if (!solve_on(round > 0)) return;
    // at the start the loads of contacts are unknown
    const int settlings = round == 0 && free.t == 0 ? most_rounds_in_substep : 0;
    for (int i = 0; i < settlings && stiffen_to_load(members, free.h, system); ++i)
      if (!solve_on(true)) return;
    if (round == 0 && renew_friction(scene, state, search, members, free, hits, system) &&
        !solve_on(true))
      return;
    const StageTimer timer(clock, IslandStage::find_hits);
    if (close_waiting(members, free, system, hits) == 0) return;
  }
}

}  // namespace talus
