// libcore/dda/work.hpp
// What a step recomputes and may be thrown away; the comment above a group names what fills it.
// Buffers grow to the largest step and are kept: the step loop does not allocate.
#pragma once

#include <vector>

#include "contact/block_pairs.hpp"
#include "contact/contact.hpp"
#include "contact/ground_depth.hpp"
#include "contact/search.hpp"
#include "dda/block_lu.hpp"
#include "dda/contact_row.hpp"
#include "dda/island_groups.hpp"
#include "dda/island_solver.hpp"
#include "dda/state.hpp"
#include "dda/substep_numbers.hpp"

namespace talus {

/// A piece of a block's motion with constant acceleration of the centroid, from one event to the
/// next: position(t) = start + v_start (t - t_start) + a (t - t_start)^2 / 2. A flight is one
/// piece.
struct Segment {
  int block = 0;
  bool flight = false;               ///< nothing was touched
  double t_start = 0, t_end = 0;     ///< [s]
  Motion start, end;                 ///< motion just after t_start and just before t_end
  Vec3 acceleration = Vec3::Zero();  ///< of the centroid, constant over the segment [m/s2]
};

/// A contact of an island, besides its row for the solver; vectors in local axes.
struct IslandContact {
  ContactKey key;
  int a = 0, b = -1;              ///< blocks; b = -1: the ground, or a fixed body
  int pair = 0;                   ///< index into the island's pairs
  int row = 0;                    ///< of the island
  int fixed = -1;                 ///< fixed body (as body of Blocks::hulls), -1: none
  int ground_class = 0;           ///< where b and fixed are -1
  int bond = -1;                  ///< index into State::bonds, -1: none
  bool waits = false;             ///< approaches too fast to press without being hit
  int hit = -1;                   ///< index into IslandStepWork::hits, -1: not hit
  Vec3 arm = Vec3::Zero();        ///< from the centroid of A, both in the middle of the substep [m]
  Vec3 free_move = Vec3::Zero();  ///< of A's point relative to B's without contact forces [m]
  Vec3 shear = Vec3::Zero();      ///< s_n [m]
  double speed_start = 0;         ///< normal velocity at the start of the substep [m/s]
  double gap_start = 0;           ///< at the start of the substep [m]
  double gap_free = 0;            ///< at its end without contact forces [m]
  double bore = 0;                ///< normal force in the substep before [N]
  double approach = 0;            ///< normal velocity without contact forces, < 0 closing [m/s]
  double offset = 0;              ///< see ContactMemory [m]
  double bond_area = 0;           ///< share of its bond, of blocks or with the ground [m2]
  double touch = 0;               ///< it touches below this gap [m]
  double restitution = 0;         ///< of the two surfaces [-]
};

/// A contact that is hit within the substep.
struct Hit {
  std::size_t contact = 0;  ///< index into IslandStepWork::contacts
  double time = 0;          ///< from the start of the substep [s]
  double speed = 0;         ///< normal velocity just before, < 0 [m/s]
  double rebound = 0;       ///< normal velocity that the hit alone gives back [m/s]
  double fall = 0;          ///< what gravity makes of that up to the end, <= 0 [m/s]
  double target = 0;        ///< normal velocity at the end of the substep [m/s]
  bool is_free = false;     ///< the motion without contact forces leads to it
  double in_turn = 1;       ///< how many times its pair hits in turn, see hits_in_turn()
};

/// How a body turns over a substep without contact, and how hard it is to turn.
struct FreeTurn {
  Mat3 by;                    ///< from start to end, local axes
  Vec3 spin_start, spin_end;  ///< local axes [rad/s]
  Mat3 per_inertia;           ///< inverse of the inertia at the end, local axes [1/(kg m2)]
};

/// Contacts that pressed on a body from the ground in the substep before, and those of them that do
/// not press at the end of this one.
struct LostContacts {
  double all = 0;           ///< normal forces of all [N]
  double force = 0;         ///< ... of those lost [N]
  Vec3 arm = Vec3::Zero();  ///< sum of these times their arms from the centroid [N m]

  void add(double normal_force, const Vec3& at) {
    force += normal_force;
    arm += normal_force * at;
  }
};

/// What bears a body until the ground hits it in a substep and is none of the substep's contacts:
/// acceleration and spin acceleration.
struct Support {
  Vec6 acceleration = Vec6::Zero();  ///< [m/s2, rad/s2]
  double until = 0;                  ///< from the start of the substep [s]
};

/// A point of contact too far apart to close within the substep.
struct LeftOutPoint {
  int manifold = 0, point = 0;
};

/// A hit that presses, in a round of solutions.
struct ExpectedHit {
  std::size_t hit = 0;  ///< index into IslandStepWork::hits
  double impulse = 0;   ///< along the normal [N s]
  double error = 0;     ///< by which that differs from the one expected [N s]
};

/// Impulses of hits on a body: their sum about its centroid, of their normal parts, and of these
/// times the times at which they act.
struct HitSum {
  Vec6 impulse = Vec6::Zero();  ///< [N s, N m s]
  double normal = 0;            ///< [N s]
  double moment = 0;            ///< [N s2]

  void add(const Vec6& p, double p_n, double time) {
    impulse += p;
    normal += p_n;
    moment += p_n * time;
  }
};

/// What the step of islands recomputes.
struct IslandStepWork {  // clang-format off
  // form_islands
  // blocks, then fixed bodies
  std::vector<Pose> poses;                  ///< at the start of the step or substep     (n_bodies)
  std::vector<Vec3> step;                   ///< displacement ahead [m]                  (n_bodies)
  std::vector<Vec3> rotation;               ///< rotation vector ahead [rad]             (n_bodies)
  std::vector<double> turn;                 ///< path of turning ahead [m]               (n_bodies)
  std::vector<std::uint8_t> moving, awake;  ///<                                         (n_bodies)
  std::vector<std::uint8_t> fixed;          ///< 1: never moves; empty: none is          (n_bodies)
  std::vector<int> group;                   ///< no contacts within; empty: all meet     (n_bodies)
  PairWork pairs;
  std::vector<std::pair<int, int>> joined;  ///< blocks within reach of each other
  std::vector<std::uint8_t> near_fixed;     ///< 1: within reach of a fixed body         (n_blocks)
  std::vector<int> joined_manifold;         ///< of each                                 (n_joined)
  bool pairs_of_step = false;               ///< `pairs` are still those of form_islands
  IslandGroups groups;
  // advance_island: the island at hand
  std::vector<int> members;                 ///< ascending
  std::vector<BlockNumbers> numbers;        ///<                                         (n_members)
  std::vector<double> bearing;              ///< mass of the heaviest block touched [kg] (n_members)
  std::vector<Substep> substeps;            ///<                                         (n_members)
  std::vector<int> place;                   ///< of a body in `members`, -1: not in it   (n_bodies)
  std::vector<double> gap_end;              ///< without contact forces [m]         (n_points of `pairs`)
  std::vector<double> thrown;               ///< by hits, about [m/s]                    (n_members)
  std::vector<LeftOutPoint> left_out;       ///< points of `pairs` that are no contacts of the substep
  std::vector<double> farthest;             ///< that contact moves a point of it [m]    (n_members)
  int touched_by = -1;                      ///< block whose memories `touched` is of
  std::vector<int> touched;                 ///< body B of each memory
  std::vector<int> continued;               ///< memory that a manifold's point continues
  std::vector<int> unclaimed;               ///< memories of the pair that no point continues yet
  std::vector<BondLoad> bond_loads;         ///< of this substep, by bond           (n_loaded)
  std::vector<PanelPush> pushes;            ///< on panels of fences, in this substep
  std::vector<FreeTurn> turns;              ///<                                         (n_members)
  std::vector<IslandContact> contacts;      ///< in the order of the island's rows
  std::vector<int> first_contact;           ///< of each pair of the island              (n_pairs)
  Island island;
  IslandWork solver;
  std::vector<int> island_manifolds;        ///< of the island at hand
  std::vector<Support> support;             ///<                                         (n_members)
  std::vector<int> ground_pair;             ///< with the ground, -1: none               (n_members)
  std::vector<std::size_t> waiting;         ///< contacts that wait for their hit
  std::vector<Hit> hits;                    ///< in the order in which they were found
  std::vector<std::size_t> hit_pairs;       ///< pairs of the island with a hit
  IndexSet hit_members;                     ///< hit by the ground without contact forces
  IndexSet opened;                          ///< members with contacts with the ground that a hit opened
  IndexSet moved;                           ///< by solutions since hits were looked for last
  bool any_bond = false;                    ///< a contact is part of a bond
  std::vector<LostContacts> lost;           ///<                                         (n_members)
  std::vector<Vec3> ground_impulse;         ///< hits aside [N s]                        (n_members)
  std::vector<HitSum> hit_sums;             ///<                                         (n_members)
  std::vector<ExpectedHit> expected, last_expected;  ///< in this round of solutions and the one before
  std::vector<double> time;                 ///< at which its velocity changes, on the mean [s] (n_members)
  std::vector<double> last_time;            ///< `time` before it was set last [s]       (n_members)
  std::vector<double> weight, delay;        ///< impulses expected [N s]; times delays [N s2] (n_members)
  std::vector<std::uint8_t> is_timed;       ///< 1: has a `time` of its own              (n_members)
  std::vector<std::uint8_t> shifted;        ///< 1: `time`, or what bears it, changed    (n_members)
  std::vector<Vec6> kept_velocity;          ///< of the solution with all rebound        (n_members)
  std::vector<RowGroup> kept_rows;          ///< ... and its rows
  std::vector<Vec6> displacement;           ///< by contact over the substep             (n_members)
  std::vector<std::uint8_t> pressed;        ///< 1: by a contact, in the substep         (n_members)
};  // clang-format on

/// The block's part of Eq. (3) without contacts, in local axes: law paper.
template <int Dof>
struct BlockEquations {
  using Vec = Eigen::Matrix<double, Dof, 1>;
  using Mat = Eigen::Matrix<double, Dof, Dof>;
  Mat K;
  Vec F;
  Vec velocity;  ///< at the start of the step
  Mat3 R;        ///< body to local axes at the start
};

/// Between what a contact of law paper acts; its row's point is the arm of A.
struct PaperSides {
  int a = 0, b = -1;          ///< members of the island; b = -1: the ground
  Vec3 arm_b = Vec3::Zero();  ///< from the centroid of B, local axes [m]
  int ground_class = 0;       ///< where b is -1
  int bond = -1;              ///< index into State::bonds, -1: none
};

/// What an island's step by law paper recomputes.
template <int Dof>
struct OpenCloseWork {  // clang-format off
  using Vec = Eigen::Matrix<double, Dof, 1>;
  std::vector<BlockEquations<Dof>> equations;  ///<                                      (n_members)
  std::vector<ContactRow> rows;                ///< grouped by A
  std::vector<PaperSides> sides;               ///< of each row
  std::vector<ContactKey> keys;                ///< of each row
  std::vector<std::size_t> row_begin;          ///<                                  (n_members + 1)
  std::vector<std::pair<int, int>> edges;      ///< members that share contacts
  std::vector<int> outsiders;                  ///< members off the known ground, ascending
  BlockLu<Dof> lu;
  std::vector<Vec> D;                          ///< right-hand side, then solution       (n_members)
};  // clang-format on

/// What note_deep_blocks recomputes, but `is_suspect`, which a step fills.
struct DeepWork {  // clang-format off
  std::vector<std::uint8_t> is_suspect;   ///< 1: by a contact it is deep in something   (n_blocks)
  std::vector<Pose> poses;                ///< at the end of the step                    (n_bodies)
  std::vector<std::uint8_t> moving;       ///< 1: is placed there                        (n_bodies)
  std::vector<Mat3> stretch;              ///< empty for rigid blocks                    (n_bodies)
  PlacedHulls placed;
  AxisScratch axis;
  GroundDepthScratch ground;
  std::vector<double> overlap_depth;      ///< with other bodies [m]                     (n_blocks)
  std::vector<int> overlap_partner;       ///<                                           (n_blocks)
};  // clang-format on

struct Work {  // clang-format off
  // find_contacts: candidates of the block at hand
  std::vector<Vec3> world_vertices;          ///< at the predicted pose [m]
  std::vector<Contact> contacts;             ///< of the block at hand             (n_candidates)
  std::vector<NearFeatures> near_ground;     ///< what each block may touch there      (n_blocks)
  // make_rows, solve_contacts
  std::vector<ContactRow> rows;              ///< of the block at hand
  // advance_block: the motion of this step, block by block, in order of time
  std::vector<Segment> segments;
  IslandStepWork islands;
  DeepWork deep;
  OpenCloseWork<6> paper_rigid;
  OpenCloseWork<12> paper_strained;
  std::vector<int> members, manifolds;       ///< of the island at hand, law paper
};  // clang-format on

}  // namespace talus
