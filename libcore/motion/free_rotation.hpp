// libcore/motion/free_rotation.hpp: public
// Attitude of a rigid body that spins freely, by the cheapest of its exact forms.
// theory 1.10 (angular momentum kept to rounding)
#pragma once

#include "motion/pose.hpp"

namespace talus {

/// Attitude of a body that spins freely for `h` seconds with angular momentum `L` [kg m2/s].
///
/// `inertia` holds the principal moments, axes = body axes; L is a constant of the call. Up to half
/// a radian series_rotation(), beyond it the closed form of motion/free_spin.hpp; a body with two
/// equal moments: exact.
[[nodiscard]] Quat free_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia,
                                 double h);

}  // namespace talus
