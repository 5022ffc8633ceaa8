// libcore/step/substep_numbers.hpp
// Constants of a block and its free motion over a substep, as step/substep.hpp computes them.
#pragma once

#include "scene/state.hpp"

namespace talus {

/// Constants of one block in one run.
struct BlockNumbers {
  double mass = 0;                  ///< [kg]
  double radius = 0;                ///< of the ball around its vertices [m]
  double thickness = 0;             ///< least extent [m]
  double stiffness = 0;             ///< k_n of a contact that feels the whole mass [N/m]
  double recovery_time = 0;         ///< overlap is pressed out over this time [s]
  double touch = 0;                 ///< a contact is touching when its gap is below this [m]
  double resting_speed = 0;         ///< below this approach there is no impact [m/s]
  double located_speed = 0;         ///< above this, at most resting_speed, it ends a substep [m/s]
  double gravity = 0;               ///< [m/s2]
  Vec3 inertia = Vec3::Zero();      ///< principal moments [kg m2]
  double per_mass = 0;              ///< [1/kg]
  Vec3 per_inertia = Vec3::Zero();  ///< [1/(kg m2)]
  /// Where contacts are as stiff as their load asks, with those above for the whole mass: k_n of
  /// one that carries little and of one that nothing makes stiffer [N/m]; the overlap under its
  /// load, 0: all have `stiffness` [m]; the speed of slip or of opening from which it does not rest
  /// [m/s].
  double least_stiffness = 0, most_stiffness = 0, sag = 0, slow = 0;
  bool stands = false;  ///< island: counts as fixed, since it sleeps
  bool rests = false;   ///< island: slower than that when the substep begins, or factored
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
  bool is_straining = false;              ///< its vertices move by `straining` besides
  Mat3 straining = Mat3::Zero();          ///< strain rate at the start, body axes [1/s]
};

}  // namespace talus
