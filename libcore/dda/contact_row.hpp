// libcore/dda/contact_row.hpp
// A contact as the contact law of law talus sees it: what the step gives it, and what it finds.
// theory 1.7, 1.8
#pragma once

#include "contact/contact.hpp"

namespace talus {

/// Normal impulse that no contact reaches; its square is finite.
inline constexpr double no_normal_limit = 1e150;

/// A contact made ready for the contact law; velocities are those of block A's point relative to
/// B's.
struct ContactRow {
  Vec3 normal = Vec3::Zero();  ///< body axes of A, unit
  Vec3 point = Vec3::Zero();   ///< lever arm in the middle of the step, body axes of A [m]
  Vec3 drift = Vec3::Zero();   ///< velocity at the end is T(point) v + drift, body axes [m/s]
  Vec3 shear = Vec3::Zero();   ///< s_n, body axes [m]
  Vec3 shear_velocity = Vec3::Zero();  ///< s_n / tau [m/s]
  Vec3 slip_start = Vec3::Zero();  ///< unit direction of sliding at the start of the step, or zero
  double bias = 0;                 ///< b_n: N > 0 needs v_n + b_n < 0 [m/s]
  double normal_damping = 0;       ///< D_n, impulse per velocity below -b_n [kg]
  double shear_damping = 0;        ///< D_t, impulse per tangential velocity while sticking [kg]
  double friction = 0;             ///< tan(phi) [-]
  double cohesion_impulse = 0;     ///< c A_c h [N s]
  double tension_impulse = 0;      ///< t A_c h [N s]
  double normal_limit = no_normal_limit;  ///< a normal impulse does not grow beyond it [N s]
  Vec3 free_move = Vec3::Zero();  ///< displacement of the point without contact, body axes [m]
  double speed_start = 0;         ///< normal velocity at the start of the step [m/s]
  double gap_start = 0;           ///< gap at the start of the step, without `offset` [m]
  double offset = 0;              ///< see ContactMemory [m]
  double last_stiffness = 0;      ///< ContactMemory::stiffness, 0: new [N/m]
  double last_force = 0;          ///< ContactMemory::normal_force [N]
  double bond_area = 0;           ///< [m2]
  int contact = 0;                ///< index into Work::contacts
  int memory = -1;                ///< index into the block's memory, -1: new
  bool waits_for_impact = false;  ///< approaches too fast for the step: presses nothing until hit
  // set by solve_contacts: the law at its last evaluation
  Vec3 trial = Vec3::Zero();      ///< v_t + s / tau [m/s]
  Vec3 direction = Vec3::Zero();  ///< of slip in the middle of the step, unit; while slipping
  double trial_speed = 0;         ///< |trial| [m/s]
  double cap = 0;                 ///< bound of the tangential impulse [N s]
  bool gives_way = false;         ///< the normal impulse is at its limit
  Vec3 impulse = Vec3::Zero();    ///< on A, body axes [N s]
  ContactState state = ContactState::open;
};

}  // namespace talus
