// libcore/dda/flight.hpp
// Motion without contact: exact translation, free spin, and how long nothing can be hit.
// theory 1.10, 3.5 (2)
#pragma once

#include "contact/ground.hpp"
#include "dda/state.hpp"

namespace talus {

/// Motion after `h` seconds of constant acceleration `a` of the centroid and no torque. Exact in
/// translation, angular momentum untouched.
[[nodiscard]] Motion fly(const Motion& motion, const Vec3& inertia, const Vec3& a, double h);

/// A time for which a ball of `radius` on the parabola x + v t + a t^2 / 2 stays above the ground
/// for sure, at most `limit` and not beyond the grid's edge; 0 when none was found. Far above by
/// bounds of the ground below the path, near it by the planes of its triangles, cell by cell, which
/// unknown ground ends.
[[nodiscard]] double free_time(const Ground& ground, double radius, const Vec3& x, const Vec3& v,
                               const Vec3& a, double limit);

}  // namespace talus
