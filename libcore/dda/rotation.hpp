// libcore/dda/rotation.hpp
// Finite rotation and the free spin of a rigid body.
// theory 1.9 (no volume growth), 1.10 (symmetric splitting, angular momentum kept to rounding)
#pragma once

#include "contact/pose.hpp"

namespace talus {

/// Quaternion of the rotation by |r| about r: R = exp([r]x), so that no rotation changes a volume.
[[nodiscard]] Quat rotation_by(const Vec3& r);

/// Attitude of a body that spins freely for `h` seconds with angular momentum `L` [kg m2/s].
///
/// `inertia` holds the principal moments, axes = body axes. Symmetric splitting into rotations
/// about the body axes, composed to order 4 (Suzuki), in substeps of |omega| h <= 0.06; L is a
/// constant of the call, the energy error stays bounded. A body with two moments equal to 1e-9:
/// exact.
[[nodiscard]] Quat free_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia,
                                 double h);

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
