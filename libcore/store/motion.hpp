// libcore/store/motion.hpp
// A block's motion at any moment of a segment, and what is recorded of it.
// in:    segments of the solver (dda/work.hpp), pieces of constant acceleration of the centroid
// out:   motion, energies; the same numbers for frames, passages and crossings
#pragma once

#include "dda/rotation.hpp"
#include "dda/scene.hpp"
#include "dda/work.hpp"

namespace talus {

/// Motion at `t`, t_start <= t <= t_end, of a body with principal moments `inertia` [kg m2].
///
/// A flight is followed exactly: parabola and free spin. Between two steps with contact the
/// centroid keeps the segment's acceleration, the attitude turns evenly (slerp), velocity and
/// angular momentum go linearly. At both ends the solver's own bits come back.
[[nodiscard]] Motion motion_at(const Segment& segment, const Vec3& inertia, double t);

[[nodiscard]] double translational_energy(double mass, const Vec3& velocity);  ///< m v^2 / 2 [J]
/// omega . L / 2 [J].
[[nodiscard]] double rotational_energy(const Motion& motion, const Vec3& inertia);

}  // namespace talus
