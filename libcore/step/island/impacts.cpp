// Stage 7 of an island's step, the contact impulses, and how stages 6 and 7 follow on each other.
#include <algorithm>

#include "solver/law_numbers.hpp"
#include "step/island/stages.hpp"

namespace talus {
namespace {

using std::size_t;

using law::island_tolerance, law::linear_tolerance, law::motion_tolerance, law::most_closing_rounds,
    law::rest_tolerance, law::small_tolerance;

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
  const double by_gravity = scene.gravity.norm() * free.h;
  settings.tolerance = small_tolerance * by_gravity;
  settings.direct_bodies = members.is_small ? static_cast<int>(members.size()) : 0;
  if (!members.is_small) {
    settings.tolerance = std::clamp(motion_tolerance * fastest(free), rest_tolerance * by_gravity,
                                    island_tolerance * by_gravity);
    settings.linear_tolerance = linear_tolerance;
  }
  settings.tolerance *= scene.settings.tolerance_factor;
  const IslandResult solved = solve_island(system.island, settings, solver);
  solution.passes += solved.passes;
  solution.converged = solved.converged;
  for (const int k : solver.touched_bodies.items) hits.moved.add(k);
}

void solve_with_hits(const Scene& scene, const State& state, const PairSearch& search,
                     const IslandMembers& members, std::vector<NearFeatures>& near_ground,
                     ContactMaking& making, FreeMotions& free, IslandSystem& system,
                     SubstepHits& hits, IslandWork& solver, StageClock* clock, Solution& solution) {
  {
    const StageTimer timer(clock, IslandStage::find_hits);
    find_hits(scene, state, search, members, near_ground, making, free, system, hits);
    solution.passes += hits.passes;
  }
  for (int round = 0; round < most_closing_rounds; ++round) {
    {
      const StageTimer timer(clock, IslandStage::solve);
      solve(scene, members, free, round > 0, system, hits, solver, solution);
    }
    if (!solution.converged) return;
    const StageTimer timer(clock, IslandStage::find_hits);
    if (close_waiting(members, free, system, hits) == 0) return;
  }
}

}  // namespace talus
