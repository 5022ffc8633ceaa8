// libcore/motion/rotation.hpp: public
// Finite rotation, and the parts of free spin: series, symmetry, momentum.
// theory 1.9 (no volume growth), 1.10 (angular momentum kept to rounding)
#pragma once

#include "motion/pose.hpp"

namespace talus {

/// Quaternion of the rotation by |r| about r: R = exp([r]x), so that no rotation changes a volume.
[[nodiscard]] Quat rotation_by(const Vec3& r);

/// free_rotation() by the power series of Euler's equations in parts of |omega| h <= 0.5, cut where
/// a term falls below 1e-13: takes the longer the more it turns, and any body.
[[nodiscard]] Quat series_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia,
                                   double h);

/// The first body axis about which the other two principal moments are equal but for the rounding
/// of coordinates; -1: none.
[[nodiscard]] int axis_of_symmetry(const Vec3& inertia);
[[nodiscard]] inline bool has_two_equal_moments(const Vec3& inertia) {
  return axis_of_symmetry(inertia) >= 0;
}

/// free_rotation() of a body with two equal moments, `axis` being the third's: it precesses
/// steadily, about L at |L| / I_across, and about its own axis at the remaining spin.
[[nodiscard]] Quat symmetric_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia,
                                      int axis, double h);

/// Fastest that a freely spinning body ever turns [rad/s]: of all motions with its energy and
/// momentum, |omega|^2 <= 2 E (1 / I_min + 1 / I_max) - L^2 / (I_min I_max).
[[nodiscard]] double fastest_spin(const Quat& attitude, const Vec3& L, const Vec3& inertia);

/// omega = I^-1 L in local axes [rad/s].
[[nodiscard]] inline Vec3 angular_velocity(const Quat& attitude, const Vec3& L,
                                           const Vec3& inertia) {
  const Vec3 body = attitude.conjugate() * L;
  return attitude * body.cwiseQuotient(inertia).eval();
}

/// L = I omega in local axes [kg m2/s].
[[nodiscard]] inline Vec3 angular_momentum(const Quat& attitude, const Vec3& omega,
                                           const Vec3& inertia) {
  const Vec3 body = attitude.conjugate() * omega;
  return attitude * body.cwiseProduct(inertia).eval();
}

}  // namespace talus
