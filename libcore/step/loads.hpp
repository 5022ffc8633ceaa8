// libcore/step/loads.hpp: public
// What drives a block besides its contacts: gravity, base motion, point loads.
// theory 1.5
#pragma once

#include "scene/scene.hpp"

namespace talus {

/// Acceleration of a free block over a step, in the ground's frame: gravity less the mean of the
/// base acceleration, plus point loads over mass [m/s2].
[[nodiscard]] Vec3 free_acceleration(const Scene& scene, int b, double t_start, double t_end);

/// By how much the acceleration of the base ranges from `from` to `to` [m/s2].
[[nodiscard]] double range_of_base(const AccelerationRecord& base, double from, double to);

/// Torque of the point loads about the centroid of block b, local axes [N m].
[[nodiscard]] Vec3 load_torque(const Scene& scene, int b, const Quat& attitude);

}  // namespace talus
