// libcore/step/island/data.hpp
// Scratch of the step of an island, each struct by its life. The nine stages that fill them are in
// step/island/stages.hpp; the comment at a group names the stage. PairSearch: a step, for all
// islands. All else is in IslandScratch: the island at hand, so that each thread could have one of
// its own. Buffers grow to the largest step and are kept.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/index_set.hpp"
#include "contact/block_pairs.hpp"
#include "contact/hulls.hpp"
#include "contact/manifold.hpp"
#include "contact/search.hpp"
#include "scene/bond_face.hpp"
#include "scene/bonds.hpp"
#include "scene/fixed_bodies.hpp"
#include "scene/state.hpp"
#include "solver/contact_row.hpp"
#include "solver/impact_solve.hpp"
#include "solver/island_groups.hpp"
#include "solver/island_solver.hpp"
#include "solver/law_numbers.hpp"
#include "solver/newton.hpp"
#include "step/island/pair_memories.hpp"
#include "step/report.hpp"
#include "step/stage_clock.hpp"
#include "step/substep_numbers.hpp"

namespace talus {

// --- of a step ---------------------------------------------------------------------------------

/// Scratch for waking together, and for falling asleep.
struct SleepScratch {
  std::vector<int> blocks, woken;            ///< that are to wake; that did, with their bonded
                                             ///< neighbours
  std::vector<std::pair<int, int>> touches;  ///< of blocks asleep, in both orders
  std::vector<std::uint8_t> is_known;        ///< among `blocks`                        (n_blocks)
  std::vector<int> sleepers;                 ///< that fall asleep
  std::vector<int> pressed, beside_motion;   ///< that other blocks press; that press moving blocks
};

/// Which blocks meet, and the bodies that they meet. Bodies are those of Blocks::hulls.
struct PairSearch {  // clang-format off
  // form_islands for all blocks; 2 find_pairs anew for those of an island
  std::vector<Pose> poses;                  ///< at the start of the step or substep     (n_bodies)
  std::vector<Vec3> step;                   ///< displacement ahead [m]                  (n_bodies)
  std::vector<Vec3> rotation;               ///< rotation vector ahead [rad]             (n_bodies)
  std::vector<double> turn;                 ///< path of turning ahead [m]               (n_bodies)
  std::vector<std::uint8_t> moving, awake;  ///<                                         (n_blocks)
  std::vector<std::uint8_t> absent;         ///< 1: touches nothing; empty: none      (n_blocks)
  std::vector<std::uint8_t> in_mass;        ///< 1: of a mass; empty: none               (n_blocks)
  BodyGrid grid;                            ///< the fixed bodies, in their first places
  std::vector<int> shifted;                 ///< bodies: the fixed ones whose pose is not that
  std::vector<int> near;                    ///< scratch: fixed bodies near a block
  std::int64_t n_fixed_near = 0;            ///< fixed bodies looked at so far, block by block
  Workers* workers = nullptr;               ///< share the pairs
  PairWork pairs;
  bool is_of_step = false;                  ///< `pairs` are still those of form_islands
  // form_islands
  std::vector<std::pair<int, int>> joined;  ///< blocks within reach of each other
  std::vector<int> joined_manifold;         ///< of each                                 (n_joined)
  std::vector<std::uint8_t> near_fixed;     ///< 1: within reach of a fixed body         (n_blocks)
  IslandGroups groups;
  SleepScratch sleep;
};  // clang-format on

/// State of a block before the step of a lone block, which may change it.
struct LoneBefore {
  int block = 0;
  Phase phase = Phase::near_ground;
  double local_time = 0, flight_end = 0;
  Pose rest_pose;
  int rest_steps = 0;
  Motion motion;
  Vec3 acceleration, spin_rate, support;
  Vec6 strain, strain_rate;
  std::vector<ContactMemory> memory;
  SlipMemory slid;
  MassShare mass;
  double hit_loss = 0;
  std::uint8_t is_suspect = 0;  ///< of DeepWork
};

/// 2 find_pairs: which blocks move alone (step/island/untouched.hpp).
struct UntouchedScratch {  // clang-format off
  std::vector<std::uint8_t> alone;   ///< 1: moved already, as a lone block       (n_blocks)
  std::vector<int> blocks;           ///< those of the island at hand that may move alone
  std::vector<LoneBefore> before;    ///< their state before; grows to the largest island
};  // clang-format on

// --- of an island in a step --------------------------------------------------------------------

/// 1 gather_members; their stiffness: 3 choose_stiffness.
struct IslandMembers {  // clang-format off
  std::vector<int> blocks;                  ///< ascending
  std::vector<BlockNumbers> numbers;        ///<                                         (n_members)
  std::vector<int> place;                   ///< of a body in `blocks`, -1: not in it    (n_bodies)
  std::vector<int> moving;                  ///< blocks that are not fixed, ascending
  bool is_small = false;                    ///< the island's matrix is cheap to factor
  bool is_soft = false;                     ///< no load makes its contacts stiffer
  bool locates_hits = false;                ///< a hit ends the substep, as of a lone block
  std::vector<double> bearing;              ///< mass of the heaviest block touched [kg] (n_members)
  // clang-format on
  [[nodiscard]] std::size_t size() const { return blocks.size(); }
  [[nodiscard]] std::size_t block(std::size_t k) const {
    return static_cast<std::size_t>(blocks[k]);
  }
  [[nodiscard]] std::size_t at(int b) const { return static_cast<std::size_t>(place[b]); }
  [[nodiscard]] const BlockNumbers& of(int b) const { return numbers[at(b)]; }
  [[nodiscard]] bool moves(int b) const { return place[b] >= 0 && !of(b).stands; }
};

/// Mass of a block over that with which it counts as fixed: nothing feels the rest.
inline constexpr double share_of_standing_mass = std::numeric_limits<double>::epsilon();

/// Mean load between two members over a substep.
struct PairPress {
  int a = 0, b = 0;  ///< blocks
  Vec6 on_a, on_b;   ///< force, and couple about its centroid [N, N m]
};

// --- of a substep ------------------------------------------------------------------------------

/// How a body turns over a substep without contact, and how hard it is to turn.
struct FreeTurn {
  Mat3 by;                    ///< from start to end, local axes
  Vec3 spin_start, spin_end;  ///< local axes [rad/s]
  Mat3 inverse_inertia;       ///< inverse of the inertia at the end, local axes [1/(kg m2)]
};

/// 4 predict.
struct FreeMotions {
  double t = 0, h = 0;            ///< start and length of the substep [s]
  std::vector<Substep> substeps;  ///<                                                   (n_members)
  std::vector<FreeTurn> turns;    ///<                                                   (n_members)
};

/// Bodies and contacts of the substep.
struct IslandSystem {  // clang-format off
  Island island;                            ///< 4: its bodies; 5: pairs, rows; 7: solution
  // 5 make_contacts
  std::vector<KeptContact> contacts;        ///< in the order of the island's rows
  std::vector<int> first_contact;           ///< of each pair of the island              (n_pairs)
  std::vector<int> pair_manifold;           ///< index into PairSearch::pairs, -1: ground (n_pairs)
  std::vector<int> ground_pair;             ///< with the ground, -1: none               (n_members)
  std::vector<std::size_t> waiting;         ///< contacts that wait for their hit
  bool has_bonds = false;                   ///< a contact is part of a bond
  bool converges_slowly = false;                     ///< 7: its forces took many passes
  bool fell_through = false;                ///< a member is wholly below the ground
  int outsider = -1;                        ///< block off the known ground, -1: none
};  // clang-format on

/// Scratch of 5 make_contacts.
struct ContactMaking {  // clang-format off
  std::vector<Vec3> world_vertices;         ///< of the member at hand [m]
  std::vector<Contact> found;               ///< with the ground, of the member at hand
  std::vector<ContactRow> rows;             ///< of these
  std::vector<ContactMemory> unbonded;      ///< memory of a member whose bond with the ground broke
  PairMemories memories;                    ///< of the manifold at hand
};  // clang-format on

/// Where a member is at a time, and how it moves.
struct PlacedMotion {
  Vec3 position = Vec3::Zero();  ///< of its centroid [m]
  Mat3 turn = Mat3::Identity();  ///< since the start of the substep, local axes
  Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();
};

/// The same, with its attitude and momentum.
struct MemberMotion {
  Motion motion;
  PlacedMotion placed;
};

/// Free flight of a member between two hits. Until its first hit, the support of the substep before
/// continues to act.
struct FlyingMember {
  Motion motion;                ///< at `clock`
  double clock = 0;             ///< its last hit, from the start of the substep [s]
  Vec3 support = Vec3::Zero();  ///< acceleration by its support [m/s2]
  double support_until = 0;     ///< from the start of the substep [s]
  Vec3 torque = Vec3::Zero();   ///< of loads [N m]
  bool was_hit = false;
  int version = 0;       ///< number of changes of its motion
  int end_version = -1;  ///< of `end`
  PlacedMotion end;      ///< at the end of the substep
  int now_version = -1;  ///< of `now` ...
  double now_time = -1;  ///< ... and its time, that which was asked for last [s]
  MemberMotion now;
};

/// A time at which a pair has to be looked at, since it may be hit then.
struct ImpactCandidate {
  double time = 0;   ///< [s]
  int pair = 0;      ///< of the island
  int version = 0;   ///< of its two members together; older looks are void
  double from = 0;   ///< the gap was `gap` then, open [s]
  double gap = 0;    ///< [m]
  double speed = 0;  ///< at which it is expected to close, > 0 [m/s]
  int tries = 0;     ///< to find the time
};

/// A piece of a member's path that ends with a hit.
struct PathToHit {
  std::size_t member = 0;
  double begin = 0, end = 0;  ///< from the start of the substep [s]
  Motion start, stop;         ///< just after `begin`, just before `end`
};

/// 6 find_hits: the contacts hit, their times, and the motion of the members from then on.
struct SubstepHits {  // clang-format off
  std::vector<std::size_t> contacts_hit;    ///< in the order in which they were found
  std::vector<FlyingMember> members;        ///<                                         (n_members)
  std::vector<PathToHit> paths;             ///< in order of time
  std::vector<double> pair_time;            ///< when contacts change velocities [s]     (n_pairs)
  std::vector<Vec6> displacement;           ///< by contact, hits aside                  (n_members)
  std::vector<Vec6> impact_displacement;                 ///< displacement by hits                    (n_members)
  std::vector<ImpactContact> impulses;      ///< of blocks that may break or be crushed, else none
  std::vector<Vec3> bond_impulse;           ///< of contacts with bonds, by hits [N s]; empty: none
  double dissipated = 0;                    ///< by hits, but for friction [J]
  double by_friction = 0;                   ///< ... by friction and by the support of members [J]
  double by_rolling = 0;                    ///< ... by resistance to rolling [J]
  int n_hits = 0;                           ///< contacts hit, and how often
  int passes = 0;                           ///< of their solutions
  bool converged = true;
  IndexSet hit_members;
  IndexSet moved;                           ///< by solutions since hits were looked for last
  // scratch
  std::vector<ImpactCandidate> queue;              ///< a heap, by time
  std::vector<ImpactCandidate> due;                ///< taken from it, of one time
  std::vector<int> pair_begin, pairs;       ///< pairs of each member
  std::vector<int> n_looks, n_pair_hits;    ///<                                         (n_pairs)
  std::vector<std::uint8_t> is_closed;      ///< 1: looked at no more                    (n_pairs)
  std::vector<std::uint8_t> is_pressed;     ///< 1: by something, before the hits        (n_members)
  std::vector<ImpactContact> touching, batch;  ///< bodies: members
  std::vector<int> group;                   ///< of members hit at one time              (n_members)
  std::vector<int> local;                   ///< body of a member in the impact at hand  (n_members)
  std::vector<ImpactBody> bodies;
  std::vector<Motion> before;               ///< of these
  std::vector<ImpactContact> contacts;
  std::vector<std::size_t> changed;         ///< members
  ImpactWork impact;
  PlacedHulls placed;
  AxisScratch axis;
  ClipScratch clip;
  std::vector<HeldPoint> held;
  std::vector<PairManifold> manifolds;
  std::vector<PairPoint> points;
};  // clang-format on

/// Result of the substep.
struct SubstepEnd {  // clang-format off
  // 8 check_substep
  std::vector<Vec6> displacement;           ///< by contact                              (n_members)
  std::vector<BondFace> bond_faces;         ///< and their loads                        (n_bonded)
  double error = 0;                         ///< estimated, as a share of the displacement [-]
  std::vector<YieldPush> pushes;            ///< on yielding fixed bodies
  std::vector<PairPress> presses;           ///< where needed to find sleeping blocks
  std::vector<Vec6> load_change;            ///< of those asleep                        (n_members)
  SleepScratch sleep;                         ///< its `blocks` have to be awake in it
  // 9 accept
  std::vector<std::uint8_t> pressed;        ///< 1: by a contact                         (n_members)
  std::vector<Vec3> ground_impulse;        ///< hits aside [N s]                        (n_members)
};  // clang-format on

/// Verdict on an attempt at a substep.
struct SubstepVerdict {
  enum class Kind : std::uint8_t { accept, again, left } kind = Kind::accept;
  SubstepCut reason = SubstepCut::unconverged;  ///< where it is made again
  double h = 0;                                 ///< for which [s]

  static SubstepVerdict accept() { return {}; }
  static SubstepVerdict again(SubstepCut reason, double h) { return {Kind::again, reason, h}; }
  /// A member left the known ground.
  static SubstepVerdict left() { return {Kind::left}; }
};

/// Record of the attempts at a substep so far, and of those of the step.
struct SubstepRetries {
  // of the substep
  int halvings = 0;              ///< because it did not converge
  int used_up_cuts = 0;          ///< at the time when a yielding body is used up
  std::vector<BondFace> broken;  ///< bonds that it breaks
  // of the step
  double last_h = 0;   ///< length of the substep before, or of the step [s]
  double longest = 0;  ///< the next one is not tried longer, because of its error [s]
  int eased = 0;       ///< contacts are softer, because it did not converge
  int deep_cuts = 0;   ///< because a block would end deep in something
  int hits = 0;        ///< substeps that ended with one
  double planned = 0;  ///< of a mass: the substep that the end of a yielding body cut short [s]
};

/// The island at hand: nothing of it outlives its step.
struct IslandScratch {
  IslandMembers members;
  std::vector<int> manifolds;  ///< 2 find_pairs: of the island, indices into PairSearch::pairs
  FreeMotions free;
  IslandSystem system;
  ContactMaking making;
  SubstepHits hits;
  IslandWork solver;  ///< scratch of 7 solve
  SubstepEnd end;
  SubstepRetries tries;
  StageClock* clock = nullptr;  ///< where the stages' times are wanted; no part of a run
};

// --- access for the stages ---------------------------------------------------------------------

/// Row of contact `r` for the solver.
[[nodiscard]] inline IslandRow row_of(IslandSystem& system, std::size_t r) {
  return row_of(system.island, system.contacts[r].row);
}
[[nodiscard]] inline ConstIslandRow row_of(const IslandSystem& system, std::size_t r) {
  return row_of(system.island, system.contacts[r].row);
}

[[nodiscard]] inline IndexRange contacts_of(const IslandSystem& system, std::size_t pair) {
  const BodyPair& of = system.island.pairs[pair];
  const auto first = static_cast<std::size_t>(system.first_contact[pair]);
  return {first, first + static_cast<std::size_t>(of.row_end - of.row_begin)};
}

/// The next solution cannot continue from the last one's result for contact `r`.
inline void note_change(IslandSystem& system, std::size_t r) {
  system.island.pairs[system.contacts[r].pair].changed = true;
}

/// Presses on a yielding fixed body.
[[nodiscard]] inline bool gives_way(const IslandSystem& system, std::size_t r) {
  const ConstIslandRow row = row_of(system, r);
  return row.normal_limit() < no_normal_limit && row.state() != ContactState::open;
}

/// Relative motion of the points of contact `r`, `of` being a motion of members.
template <class Of>
[[nodiscard]] Vec3 relative(const IslandSystem& system, std::size_t r, Of&& of) {
  const Island& island = system.island;
  const BodyPair& pair = island.pairs[system.contacts[r].pair];
  const Vec3 arm = row_of(system, r).arm();
  Vec3 v = point_velocity<6>(of(static_cast<std::size_t>(pair.a)), arm);
  if (pair.b >= 0) {
    const auto kb = static_cast<std::size_t>(pair.b);
    v -= point_velocity<6>(of(kb), arm + pair.shift);
  }
  return v;
}

/// Change of a member's velocity by contact.
[[nodiscard]] inline Vec6 change(const Island& island, std::size_t k) {
  return island.velocity[k] - island.free_velocity[k];
}

/// Displacement of the points of contact `r` over the substep.
[[nodiscard]] inline Vec3 path_of_contact(const IslandSystem& system, const SubstepEnd& end,
                                          std::size_t r) {
  return system.contacts[r].free_move +
         relative(system, r, [&](std::size_t k) -> const Vec6& { return end.displacement[k]; });
}

/// Mobility of a contact's point relative to the other side's, as mobility() with local axes.
[[nodiscard]] inline Mobility mobility_at(const IslandMembers& members, const FreeMotions& free,
                                          std::size_t k, const Vec3& arm, const Vec3& normal) {
  const Mat3& inverse_inertia = free.turns[k].inverse_inertia;
  const Vec3 turn = arm.cross(normal);
  const double along = 1 / members.numbers[k].mass + turn.dot(inverse_inertia * turn);
  const double all = 3 / members.numbers[k].mass + inverse_inertia.trace() * arm.squaredNorm() -
                     arm.dot(inverse_inertia * arm);
  return {along, std::max(along, all - along)};
}

/// The thinner of the two blocks of a contact.
[[nodiscard]] inline int thinner_of(const IslandMembers& members, const KeptContact& contact) {
  if (contact.b < 0) return contact.a;
  const double a = members.of(contact.a).thickness, b = members.of(contact.b).thickness;
  return b < a ? contact.b : contact.a;
}
[[nodiscard]] inline double thickness_of(const IslandMembers& members, const KeptContact& contact) {
  return members.of(thinner_of(members, contact)).thickness;
}

/// Whether contacts of the island would be softer in another attempt that did not converge.
[[nodiscard]] inline bool can_ease(const IslandMembers& members, const SubstepRetries& tries) {
  return tries.eased < law::most_eased && !members.is_soft;
}

/// Whether a substep breaks a bond of blocks; the bond with the ground of a contact of block b.
[[nodiscard]] inline bool is_broken(const SubstepRetries& tries, int bond) {
  return std::any_of(tries.broken.begin(), tries.broken.end(),
                     [bond](const BondFace& face) { return face.bond == bond; });
}
[[nodiscard]] inline bool is_broken(const SubstepRetries& tries, int b, const Vec3& normal) {
  return std::any_of(tries.broken.begin(), tries.broken.end(), [&](const BondFace& face) {
    return face.bond < 0 && face.block == b && is_same_face(face.normal, normal);
  });
}

}  // namespace talus
