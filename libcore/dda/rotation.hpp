// libcore/dda/rotation.hpp
// Finite rotation and the free spin of a rigid body.
// theory 1.9 (no volume growth), 1.10 (angular momentum kept to rounding)
#pragma once

#include <vector>

#include "contact/pose.hpp"

namespace talus {

/// Quaternion of the rotation by |r| about r: R = exp([r]x), so that no rotation changes a volume.
[[nodiscard]] Quat rotation_by(const Vec3& r);

/// Attitude of a body that spins freely for `h` seconds with angular momentum `L` [kg m2/s].
///
/// `inertia` holds the principal moments, axes = body axes. Power series of Euler's equations in
/// parts of |omega| h <= 0.5, cut where a term falls below 1e-13; L is a constant of the call. A
/// body with two moments equal to 1e-9: exact.
[[nodiscard]] Quat free_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia,
                                 double h);

/// Appends the attitudes after one, two, ... `n` times `stride` seconds of the same free spin from
/// the last of `attitudes`; cheaper than one call of free_rotation() for each.
void add_free_rotations(std::vector<Quat>& attitudes, const Vec3& L, const Vec3& inertia,
                        double stride, int n);

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
