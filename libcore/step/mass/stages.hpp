// libcore/step/mass/stages.hpp
// The mass step: an island of which many blocks move, in five stages. The exact step
// (step/island/stages.hpp) follows hits event by event and solves for forces to far below the
// effect of gravity; a moving mass needs neither. step_mass.cpp is the page that puts the stages in
// order. Laws are those of the exact step, through the same functions: ground and its rows
// (step/substep.hpp), pairs, fences, stems, soil, drag. Simplifications:
// - a contact that closes fast rebounds within the step, once: a hit is not passed on in turn;
// - all contacts have one stiffness;
// - forces are found to within the change by the last sweep, see law numbers in
// solver/mass_numbers.hpp.
// docs/theory/theory.md, "One step of a mass"
#pragma once

#include <vector>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "solver/law_numbers.hpp"
#include "step/island/data.hpp"
#include "step/mass/data.hpp"
#include "step/report.hpp"
#include "step/work.hpp"

namespace talus {

// --- the question (step/mass/question.cpp)
/// Exact step or mass step? Asked once for an island and a step. A mass step for an island of which
/// more than mass::most_moving blocks move; until it is small, or calm for mass::calm_time, or the
/// mass step has not found its forces with most sweeps. Exact always: intact bonds, a stiffness
/// that the scene sets. Fills State::mass of the members.
[[nodiscard]] bool moves_as_mass(const Scene& scene, const IslandMembers& members, State& state);
[[nodiscard]] bool is_any_in_mass(const IslandMembers& members, const State& state);
/// The mass is exact from now on, for mass::calm_time at least.
void bar_from_mass(const Scene& scene, const IslandMembers& members, State& state);
/// Whether an island is one that a mass step can advance at all.
[[nodiscard]] bool may_be_mass(const Scene& scene, const IslandMembers& members,
                               const State& state);
/// Whether velocities that differ by `change` [m/s] in a substep of `h` differ too little to count.
[[nodiscard]] bool has_settled(const Scene& scene, double h, double change);
/// Whether a first substep would leave more than mass::most_moving blocks faster than law::slow g
/// h. Then fills State::mass of the members.
[[nodiscard]] bool leaves_as_mass(const Scene& scene, const IslandMembers& members,
                                  const FreeMotions& free, const MassScratch& w, State& state);
/// Whether a substep of `h` is longer than the nominal step.
[[nodiscard]] inline bool is_long_step(const Scene& scene, double h) {
  return h > 1.5 * scene.settings.dt;
}
/// Change of velocities by the last sweep that is too little to count in a substep of `h` [m/s].
[[nodiscard]] inline double settled_change(const Scene& scene, double h) {
  return law::least_speed * scene.gravity.norm() * (is_long_step(scene, h) ? scene.settings.dt : h);
}
/// Sweeps at least, at an accuracy [-].
[[nodiscard]] int mass_sweeps(double accuracy);
/// [-] Compliance of a contact, relative to the mobility of its point: while the mass grows calm,
/// step by step as much as in the exact step, so that nothing sags once that one has it.
[[nodiscard]] double mass_compliance(const Scene& scene, const MassShare& share);
/// Takes into State::mass how the substep of `h` was solved, and whether a long step would have
/// been accurate. A system that most sweeps do not settle counts in the report as not converged.
void note_solution(const Scene& scene, const IslandMembers& members, double h, const MassScratch& w,
                   State& state, StepReport& report);

// --- 1 predict: as for the exact step (step/island/predict.cpp)
// --- 2 make_mass_contacts (step/mass/contacts.cpp)
/// Longest substep, up to `h`, in which no point goes by more than 2 law::deep_share of the
/// thickness relative to a neighbour, or past the side of a stem; a long one by half of that, on
/// the ground too, since a body that a hit throws at another is seen only in the next.
[[nodiscard]] double longest_mass_substep(const Scene& scene, const PairSearch& search,
                                          const IslandMembers& members,
                                          std::span<const int> manifolds, double h);
/// Contacts that stay farther apart over a substep of `h` are left out [m].
[[nodiscard]] double mass_reach(const Scene& scene, double h);
/// Fills members, rows and contacts of `w`; `workers` share them, or none. False: block `outsider`
/// is off the known ground.
[[nodiscard]] bool make_mass_contacts(const Scene& scene, const State& state,
                                      const PairSearch& search, std::span<const int> manifolds,
                                      const IslandMembers& members, const FreeMotions& free,
                                      std::vector<NearFeatures>& near_ground, Workers* workers,
                                      MassScratch& w, int& outsider);

// --- 3 solve (solver/mass_solver.cpp)
// --- 4 find_mass_changes (step/mass/accept.cpp)
/// Fills changes, pushes and error: the impulses in doubles.
void find_mass_changes(const Scene& scene, const State& state, const PairSearch& search,
                       const IslandMembers& members, const FreeMotions& free, MassScratch& w);

/// As of the exact step, see step/island/stages.hpp.
void list_presses(const IslandMembers& members, double h, const MassScratch& w,
                  std::vector<PairPress>& presses);

// --- 5 accept_mass (step/mass/accept.cpp)
/// Fills motion, memory, yielding bodies and ledger of the state, the segments, and the report.
/// The memory is that of the exact step, which can continue from it, as this step can from that
/// one's. `planned`: length of the step before the break of a yielding body cut it short [s].
void accept_mass(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
                 const MassScratch& w, double planned, State& state, std::vector<Segment>& segments,
                 DeepWork& deep, StepReport& report);

}  // namespace talus
