// libcore/dda/contact_row.hpp
// A contact made ready for the solve: one struct for a lone block, an impact and an island. The
// step fills it, contact by contact; the contact law reads it, for an island from its lanes
// (RowGroup in dda/island.hpp). An island keeps, besides the lanes, its first part alone: large
// masses wait for memory. theory 1.6 (normal, arm, gap), 1.7, 1.8
#pragma once

#include "contact/contact.hpp"

namespace talus {

/// Normal impulse that no contact reaches; its square is finite.
inline constexpr double no_normal_limit = 1e150;

/// What an island keeps of a contact while its lanes are solved. Velocities and displacements are
/// those of A's point relative to B's. Axes: of A's body at the end of the substep for a lone
/// block, local ones for an island.
struct KeptContact {  // clang-format off
  // between what it acts
  ContactKey key;
  int a = 0, b = -1;              ///< blocks; b = -1: the ground, or a fixed body
  int fixed = -1;                 ///< fixed body (as body of Blocks::hulls), -1: none
  int ground_class = 0;           ///< where b and fixed are -1
  int bond = -1;                  ///< index into State::bonds, -1: none
  int memory = -1;                ///< index into A's memory, -1: new
  int pair = 0;                   ///< island: index into its pairs
  int lane = 0;                   ///< island: its number among the rows of the solver
  int hit = -1;                   ///< island: index into the hits of the substep, -1: not hit
  bool waits = false;             ///< approaches too fast to press without being hit: presses nothing
  // where it is and how it moves in the substep without contact forces
  double gap_start = 0;           ///< gap at the start, without `offset` [m]
  double gap_free = 0;            ///< island: gap at the end [m]
  double speed_start = 0;         ///< normal velocity at the start [m/s]
  double approach = 0;            ///< island: normal velocity, the smaller of start and mean [m/s]
  double offset = 0;              ///< see ContactMemory [m]
  double touch = 0;               ///< island: it touches below this gap [m]
  double restitution = 0;         ///< of the two surfaces [-]
  double bond_area = 0;           ///< share of its bond, of blocks or with the ground [m2]
  double last_force = 0;          ///< ContactMemory::normal_force [N]
  Vec3 arm = Vec3::Zero();        ///< from the centroid of A, both in the middle of the substep [m]
  Vec3 free_move = Vec3::Zero();  ///< displacement [m]
  Vec3 shear = Vec3::Zero();      ///< s_n [m]
};  // clang-format on

/// A bond that breaks within the step makes the law jump, and a step with a jump may have no
/// solution: an island takes an intact bond as one without limit, compares what it carries with the
/// limits afterwards and solves again without the bonds that were exceeded.
struct ContactRow : KeptContact {  // clang-format off
  int contact = 0;                ///< with the ground: index into what the search found
  double last_stiffness = 0;      ///< ContactMemory::stiffness, 0: new [N/m]
  Vec3 normal = Vec3::Zero();     ///< unit, from B to A
  Vec3 drift = Vec3::Zero();      ///< velocity at the end is T(arm) v + drift [m/s]
  // what the contact law reads
  Vec3 shear_velocity = Vec3::Zero();  ///< s_n / tau [m/s]
  Vec3 slip_start = Vec3::Zero(); ///< unit direction of sliding at the start, or zero
  double bias = 0;                ///< b_n: N > 0 needs v_n + b_n < 0 [m/s]
  double normal_damping = 0;      ///< D_n, impulse per velocity below -b_n [kg]
  double shear_damping = 0;       ///< D_t, impulse per tangential velocity while sticking [kg]
  double friction = 0;            ///< tan(phi) [-]
  double cohesion_impulse = 0;    ///< c A_c h [N s]
  double tension_impulse = 0;     ///< t A_c h [N s]
  double normal_limit = no_normal_limit;  ///< the other side gives way at this normal impulse [N s]
  // in, for an island: those of the last step, scaled to this one's length; out: the solution, for
  // an island in its lanes
  Vec3 impulse = Vec3::Zero();    ///< on A; B gets the opposite [N s]
  ContactState state = ContactState::open;
  bool stuck = false;             ///< at the end of the last step
  double give = 0;                ///< an impact: speed by which it gives under its impulse [m/s]
  // a lone block: the law at its last evaluation
  bool gives_way = false;         ///< the normal impulse is at its limit
  double trial_speed = 0;         ///< |trial| [m/s]
  double cap = 0;                 ///< bound of the tangential impulse [N s]
  Vec3 trial = Vec3::Zero();      ///< v_t + s / tau [m/s]
  Vec3 direction = Vec3::Zero();  ///< of slip in the middle of the step, unit; while slipping
};  // clang-format on

}  // namespace talus
