// libcore/step/island/stages.hpp
// The step of an island in nine stages: law talus for blocks within reach of each other. Each stage
// names its input and results; step_island.cpp is the page that puts them in order. Numbers,
// names and equations: docs/theory/theory.md, "One step of an island".
// theory 1.6, 1.7, 1.10, 1.12, 3.5; docs/developing/design-notes.md
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/accuracy.hpp"
#include "step/island/data.hpp"
#include "step/report.hpp"
#include "step/substep_end.hpp"
#include "step/work.hpp"

namespace talus {

// --- 1 gather_members (step/island/members.cpp)
/// Fills `members`, without the data that follow from their pairs.
void gather_members(const Scene& scene, std::span<const int> blocks, IslandMembers& members);
/// Members that sleep, or that the step has moved already in the island that woke them, are fixed.
void let_stand(const State& state, double t_end, IslandMembers& members);
/// The bodies of `members` are in no island any more.
void release_members(IslandMembers& members);
/// `blocks` belong to `members` too; they list all members afterwards.
void add_members(const Scene& scene, const State& state, std::vector<int>& blocks,
                 IslandMembers& members);

// --- 2 find_pairs (step/island/pairs.cpp)
/// Where blocks have each their own world: places the fixed bodies where block `b` has pushed them;
/// -1: in their first places, as they are between steps.
void place_own_fixed(const Scene& scene, int b, State& state, PairSearch& search);

/// Fills `manifolds` with those of island `k` that form_islands found.
void take_pairs(const Scene& scene, const State& state, const PairSearch& search, int k,
                const IslandMembers& members, std::vector<int>& manifolds);
/// Fills `search` and `manifolds` with the pairs at the poses of now, for at most `h` ahead. Of the
/// state, its memory of pairs. Blocks asleep that members come within reach of join them.
void find_pairs(const Scene& scene, double h, State& state, PairSearch& search,
                IslandMembers& members, std::vector<int>& manifolds);
/// The longest substep, up to `h`, over which the contacts found at its start still describe the
/// motion.
[[nodiscard]] double longest_substep(const Scene& scene, const State& state,
                                     const PairSearch& search, const IslandMembers& members,
                                     std::span<const int> manifolds, double h);

// --- 3 choose_stiffness (step/island/members.cpp)
/// Fills IslandMembers::is_small, which holds for a step.
void classify_size(const Scene& scene, const State& state, const PairSearch& search,
                   std::span<const int> manifolds, IslandMembers& members);
/// Fills the stiffness of the members' numbers; `eased`: SubstepRetries.
void choose_stiffness(const Scene& scene, const State& state, const PairSearch& search,
                      std::span<const int> manifolds, int eased, IslandMembers& members);
/// Fills IslandMembers::locates_hits and the members' located speed. Hits end a substep in islands
/// of at most law::few_blocks blocks, but for those between blocks that nothing presses, until
/// the step has had too many.
void locate_hits(const Scene& scene, const State& state, const SubstepRetries& tries,
                 IslandMembers& members);

// --- 4 predict (step/island/predict.cpp)
/// Fills `free` for the substep of `h` from `t`; `workers` share the members, or none.
void predict_free(const Scene& scene, const State& state, const IslandMembers& members, double t,
                  double h, Workers* workers, FreeMotions& free);
/// The same, and the bodies of `island`.
void predict(const Scene& scene, const State& state, const IslandMembers& members, double t,
             double h, FreeMotions& free, Island& island);

// --- 5 make_contacts (step/island/contacts.cpp)
/// Fills `system` but for the bodies of its island: contacts with the ground, with other members
/// and with fixed bodies. False: a member is off the known ground. `near_ground`: features that
/// each block may touch there, kept from search to search.
[[nodiscard]] bool make_contacts(const Scene& scene, const State& state, const PairSearch& search,
                                 std::span<const int> manifolds, const IslandMembers& members,
                                 const FreeMotions& free, const SubstepRetries& tries,
                                 std::vector<NearFeatures>& near_ground, ContactMaking& making,
                                 IslandSystem& system);
/// Time at which a block first touches a yielding fixed body, h + 1: none does within the substep.
[[nodiscard]] double first_touch(const Scene& scene, const State& state, const IslandSystem& system,
                                 double h);

// --- 6 find_hits (step/island/hits.cpp, impact_search.cpp, after_hits.cpp)
/// Fills `hits`: the hits of members within the substep, in order of time, each with place and
/// motion after it. That is part of the motion without contact from now on: changes `free`, and in
/// `system` bodies and rows that were hit. `near_ground`, `making`: for searches of the ground.
void find_hits(const Scene& scene, const State& state, const PairSearch& search,
               const IslandMembers& members, std::vector<NearFeatures>& near_ground,
               ContactMaking& making, FreeMotions& free, IslandSystem& system, SubstepHits& hits);
/// Contacts that wait and that the impulses found so far close press from now on, without rebound:
/// how many.
int close_waiting(const IslandMembers& members, const FreeMotions& free, IslandSystem& system,
                  SubstepHits& hits);

// --- 7 solve (step/island/impacts.cpp)
/// Result of a solution.
struct Solution {
  bool converged = true;
  int passes = 0;
};
/// Fills velocities and impulses of the island; marks the members that moved. `continues`: from the
/// last solution.
void solve(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
           bool continues, IslandSystem& system, SubstepHits& hits, IslandWork& solver,
           Solution& solution);

/// Stages 6 and 7: hits, then the contacts that press, until no contact is added.
void solve_with_hits(const Scene& scene, const State& state, const PairSearch& search,
                     const IslandMembers& members, std::vector<NearFeatures>& near_ground,
                     ContactMaking& making, FreeMotions& free, IslandSystem& system,
                     SubstepHits& hits, IslandWork& solver, StageClock* clock, Solution& solution);

// --- 8 check_substep (step/island/check.cpp)
/// Fills `end` but for the results of accept(): accept, or again with a reason. `making`,
/// `near_ground`: for searches of the ground.
[[nodiscard]] SubstepVerdict check_substep(const Scene& scene, const State& state,
                                           const PairSearch& search, const IslandMembers& members,
                                           const FreeMotions& free, const IslandSystem& system,
                                           const SubstepHits& hits, bool converged,
                                           const SubstepRetries& tries,
                                           std::vector<NearFeatures>& near_ground,
                                           ContactMaking& making, SubstepEnd& end);
/// Error by the forces of member `k`, `change` being that of its velocity by contact and
/// `displacement` that of its centroid. None where the previous contact force is unknown.
[[nodiscard]] DisplacementError error_of_member(const Scene& scene, const State& state,
                                                const IslandMembers& members,
                                                const FreeMotions& free, std::size_t k,
                                                const Vec6& change, const Vec3& displacement,
                                                double last_h);
/// Displacement of the members by contact over the substep of `h`, hits aside: each pair acts at
/// its own time.
void set_displacements(double h, const IslandSystem& system, const SubstepHits& hits,
                       std::vector<Vec6>& displacement);
/// Path per time of the points of contact `r` that its impulse works on, over the substep [m/s].
[[nodiscard]] Vec3 path_of_impulse(const IslandMembers& members, const FreeMotions& free,
                                   const IslandSystem& system, const SubstepHits& hits,
                                   std::size_t r);
/// Contact `r` at the end of the substep, where it presses.
[[nodiscard]] ContactEnd end_of_contact(const IslandMembers& members, const FreeMotions& free,
                                        const IslandSystem& system, const SubstepHits& hits,
                                        std::size_t r);
/// Motion of member k at the end of the substep.
[[nodiscard]] Motion end_of(const IslandMembers& members, const FreeMotions& free,
                            const IslandSystem& system, const SubstepEnd& end, std::size_t k);

// --- sleep (step/island/sleepers.cpp); the mass step asks too
/// Whether the loads between members matter: one sleeps, or may soon.
[[nodiscard]] bool asks_for_presses(const State& state, const IslandMembers& members);
void list_presses(const IslandMembers& members, double h, const IslandSystem& system,
                  std::vector<PairPress>& presses);
/// Adds to the blocks that are to wake those asleep that these touch, and so on: a blow goes
/// through all of a pile.
void add_piles(const State& state, SleepScratch& wake);
/// Adds to the blocks of `end` that are to wake the members asleep whose load is not the one under
/// which they fell asleep.
void find_woken(const Scene& scene, const State& state, const IslandMembers& members,
                SubstepEnd& end);
/// Clears the memory of the members' contacts, but for those between fixed members.
void forget_contacts(const IslandMembers& members, State& state);
/// They move with the rest, from `t` on.
void wake_members(const Scene& scene, double t, SleepScratch& wake, State& state,
                  IslandMembers& members);
/// Wakes before a step the blocks asleep of which a neighbour awake is in no island with them any
/// more, and the piles that a block may hit in the step. Whether there are any.
[[nodiscard]] bool wake_before_step(const Scene& scene, State& state, PairSearch& search);

// --- 9 accept (step/island/accept.cpp)
/// The substep holds: fills motion, memory, bonds, yielding bodies and ledger of the state, the
/// segments, and the report. Nothing before it changes anything of these.
void accept(const Scene& scene, const IslandMembers& members, const FreeMotions& free,
            const IslandSystem& system, const SubstepHits& hits, bool converged,
            const SubstepRetries& tries, SubstepEnd& end, State& state,
            std::vector<Segment>& segments, DeepWork& deep, StepReport& report);

}  // namespace talus
