// libcore/step/substep_numbers.hpp
// Constants of a block, and its motion without contact over a substep; step/substep.hpp makes both.
#pragma once

#include "scene/state.hpp"

namespace talus {

/// Constants of one block; the last two are those of the current substep.
struct BlockNumbers {
  double mass = 0;           ///< [kg]
  double radius = 0;         ///< of the ball around its vertices [m]
  double thickness = 0;      ///< smallest dimension [m]
  double stiffness = 0;      ///< k_n of a contact that carries the whole mass [N/m]
  double recovery_time = 0;  ///< time over which overlap is corrected [s]
  double touch = 0;          ///< a contact is touching when its gap is below this [m]
  double resting_speed = 0;  ///< below this approach there is no impact [m/s]
  double located_speed =
      0;               ///< approach from which an impact ends a substep, <= resting_speed [m/s]
  double gravity = 0;  ///< [m/s2]
  Vec3 inertia = Vec3::Zero();          ///< principal moments [kg m2]
  double inverse_mass = 0;              ///< [1/kg]
  Vec3 inverse_inertia = Vec3::Zero();  ///< [1/(kg m2)]
  double least_stiffness = 0;           ///< k_n of a contact that carries little [N/m]
  double most_stiffness = 0;            ///< upper bound of k_n [N/m]
  double sag = 0;       ///< overlap of a contact under its load; 0: all have `stiffness` [m]
  double slow = 0;      ///< speed of slip or opening from which a contact is not at rest [m/s]
  bool stands = false;  ///< asleep: in its island it counts as fixed
  bool rests = false;   ///< slower than `slow` at the start, or in an island that is factored
};

/// A substep of `h`: where the block would be without contact.
struct Substep {
  double h = 0;                           ///< [s]
  Vec3 free_acceleration = Vec3::Zero();  ///< of the centroid, local axes [m/s2]
  Motion start, free;                     ///< free: at the end of the substep without contact
  Mat3 R = Mat3::Identity();              ///< free attitude, body to local axes
  Mat3 R_start = Mat3::Identity();        ///< attitude at the start, body to local axes
  Vec3 spin_start = Vec3::Zero();         ///< body axes of the start [rad/s]
  Vec3 spin_free = Vec3::Zero();          ///< body axes [rad/s]
  bool is_straining = false;              ///< its vertices also move by `straining`
  Mat3 straining = Mat3::Zero();          ///< strain rate at the start, body axes [1/s]
};

}  // namespace talus
