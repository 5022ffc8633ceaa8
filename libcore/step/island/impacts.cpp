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
  const double by_gravity = scene.gravity.norm() * free.h;
  settings.tolerance = small_tolerance * by_gravity;
  settings.direct_bodies = members.is_small ? static_cast<int>(members.size()) : 0;
  if (!members.is_small) {
    const double by_motion = std::clamp(motion_tolerance * fastest(free),
                                        rest_tolerance * by_gravity, island_tolerance * by_gravity);
    settings.tolerance = std::max(by_motion, hit_tolerance * fastest_hit(hits));
    settings.linear_tolerance = linear_tolerance;
  }
  settings.tolerance *= scene.settings.tolerance_factor;
  const IslandResult solved = solve_island(system.island, settings, solver);
  solution.passes += solved.passes;
  solution.converged = solved.converged;
  for (const int k : solver.touched_bodies.items) hits.moved.add(k);
}

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
