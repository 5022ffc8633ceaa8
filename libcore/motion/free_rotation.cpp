// Attitude of a freely spinning rigid body, by the cheapest of its exact forms.
#include "motion/free_rotation.hpp"

#include "motion/free_spin.hpp"
#include "motion/rotation.hpp"

namespace talus {
namespace {

constexpr double series_turn = 0.5;  // beyond it the closed form is cheaper than the series [rad]

}  // namespace

Quat free_rotation(const Quat& attitude, const Vec3& L, const Vec3& inertia, double h) {
  if (L.isZero(0) || h == 0) return attitude;
  const int axis = axis_of_symmetry(inertia);
  if (axis >= 0) return symmetric_rotation(attitude, L, inertia, axis, h);
  const Vec3 spin = (attitude.conjugate() * L).cwiseQuotient(inertia);
  if (spin.norm() * h > series_turn) return attitude_after(free_spin(attitude, L, inertia), h);
  return series_rotation(attitude, L, inertia, h);
}

}  // namespace talus
