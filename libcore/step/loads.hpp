// libcore/step/loads.hpp: public
// Loads of a block besides its contacts: gravity, base motion, and point loads, which include water
// in joints.
// theory 1.5, 1.14
#pragma once

#include <span>

#include "scene/state.hpp"

namespace talus {

/// Acceleration of a free block over a step, in the ground's frame: gravity less the mean of the
/// base acceleration, plus point loads over mass [m/s2]. `pressure`: as State has it, of the loads
/// that are water's.
[[nodiscard]] Vec3 free_acceleration(const Scene& scene, int b, double t_start, double t_end,
                                     std::span<const double> pressure);

/// By how much the acceleration of the base ranges from `from` to `to` [m/s2].
[[nodiscard]] double range_of_base(const AccelerationRecord& base, double from, double to);

/// The point loads of block b.
[[nodiscard]] std::span<const PointLoad> loads_on(const Scene& scene, int b);
/// The present force of one [N].
[[nodiscard]] inline Vec3 force_of(const PointLoad& load, std::span<const double> pressure) {
  if (load.wet_face < 0) return load.force;
  return pressure[static_cast<std::size_t>(load.wet_face)] * load.force;
}
/// Whether anything is left of any of block b.
[[nodiscard]] bool is_loaded(const Scene& scene, int b, std::span<const double> pressure);

/// Torque of the point loads about the centroid of block b, local axes [N m].
[[nodiscard]] Vec3 load_torque(const Scene& scene, int b, const Quat& attitude,
                               std::span<const double> pressure);
/// Their load on its strains, body axes [N m].
[[nodiscard]] Vec6 load_strain(const Scene& scene, int b, const Quat& attitude,
                               std::span<const double> pressure);

/// Books the work of the loads on block b from one pose to another and returns their sum [N].
Vec3 book_loads(const Scene& scene, int b, const Pose& from, const Pose& to, State& state);

/// Lowers the pressure of wet faces by how far they have parted since the start; none rises again.
/// Wakes their blocks where the loss could move one.
void drain_faces(const Scene& scene, State& state);

}  // namespace talus
