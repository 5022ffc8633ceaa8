// libcore/step/mass/data.hpp
// Scratch of the mass step. The stages that fill it are in step/mass/stages.hpp. Members, manifolds
// and free motions are those of the exact step (step/island/data.hpp).
#pragma once

#include <vector>

#include "contact/contact.hpp"
#include "scene/fixed_bodies.hpp"
#include "solver/mass_solver.hpp"
#include "step/island/data.hpp"

namespace talus {

/// Where a member is and how it moves without contact, for its contacts with other members.
struct MassMember {
  Vec3 at = Vec3::Zero();             ///< centroid at the start [m]
  Vec3 middle = Vec3::Zero();         ///< ... and between start and free end [m]
  Vec3 moved = Vec3::Zero();          ///< from start to free end [m]
  Mat3 turned = Mat3::Zero();         ///< rotation from start to free end, less identity
  Vec3 velocity_start, velocity_end;  ///< [m/s]
  Vec3 spin_start, spin_end;          ///< local axes [rad/s]
  // Contacts turn it at mid-step: their effect is exact there whatever its moments of inertia.
  Quat attitude = Quat::Identity();  ///< at mid-step
  Vec3 momentum;                     ///< ... angular, without contact [kg m2/s]
  Vec3 spin;                         ///< ... local axes [rad/s]
  Mat3 inverse_inertia;              ///< ... inverse of the inertia, local axes [1/(kg m2)]
};

/// A contact of the mass, beside its row in the solver.
struct MassContact {
  ContactKey key;          ///< as that of ContactMemory
  int a = 0, b = -1;       ///< blocks; b = -1: the ground, or a fixed body
  int fixed = -1;          ///< id of a fixed body, -1: none
  int ground_class = 0;    ///< where b and fixed are -1
  double gap_free = 0;     ///< at the end of the step without contact [m]
  double speed_start = 0;  ///< normal velocity at the start [m/s]
  float slip_speed = 0;    ///< of its point when the step begins [m/s]
  bool is_hit = false;     ///< it closes faster than a contact at rest, and rebounds
  bool yields = false;     ///< the other side yields
};

/// Changes of a member by its contacts.
struct MassChange {
  Vec3 impulse = Vec3::Zero();    ///< [N s]
  Vec3 couple = Vec3::Zero();     ///< about `middle` [N m s]
  Vec3 velocity = Vec3::Zero();   ///< change [m/s]
  Vec3 spin = Vec3::Zero();       ///< change [rad/s]
  Vec3 by_ground = Vec3::Zero();  ///< impulse of the ground and of fixed bodies [N s]
  bool pressed = false;           ///< by a contact
  bool on_ground = false;         ///< ... with the ground
  bool was_hit = false;
};

/// Rows of consecutive members on the ground, or of consecutive manifolds, and the scratch of the
/// thread that makes them. Numbers count from the first of the part.
struct MassPart {
  std::vector<MassRow> rows;
  std::vector<MassPair> pairs;
  std::vector<MassTurn> turns;
  std::vector<RowArm> arms;
  std::vector<MassContact> contacts;
  std::vector<int> ground_pair;  ///< of the part's members; none: of manifolds
  bool fell_through = false;     ///< a member is wholly below the ground
  int outsider = -1;             ///< block off the known ground, -1: none
  ContactMaking making;
};

struct MassScratch {  // clang-format off
  // 2 make_mass_contacts
  std::vector<MassPart> parts;              ///< one without further threads
  std::vector<MassMember> members;          ///<                                        (n_members)
  MassSystem system;                        ///< bodies: members
  std::vector<MassContact> contacts;        ///< of the rows                               (n_rows)
  std::vector<int> ground_pair;             ///< with the ground, -1: none              (n_members)
  bool fell_through = false;                ///< a member is wholly below the ground
  // 3 solve
  MassResult solved;
  // 4 check, 5 accept
  std::vector<MassChange> changes;          ///<                                        (n_members)
  std::vector<YieldPush> pushes;            ///< on yielding fixed bodies
  double error = 0;                         ///< estimated, as a share of the displacement [-]
};  // clang-format on

}  // namespace talus
