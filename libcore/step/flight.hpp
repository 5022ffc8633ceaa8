// libcore/step/flight.hpp
// Motion without contact: exact translation, free spin, and how long nothing can be hit.
// theory 1.10, 3.5 (2)
#pragma once

#include <span>

#include "contact/ground.hpp"
#include "scene/state.hpp"

namespace talus {

/// A body in free flight, for free_time().
struct FlyingBody {
  Vec3 position, velocity;              ///< of the centroid [m, m/s]
  double radius = 0;                    ///< of the ball around the centroid that holds it [m]
  std::span<const Vec3> vertices = {};  ///< body axes; empty: known as that ball alone [m]
  Mat3 R = Mat3::Identity();            ///< body to local axes
  Vec3 spin = Vec3::Zero();             ///< now, local axes [rad/s]
  double bend = 0;   ///< no point goes off its tangent about the centroid by more
                     ///< than radius bend t^2 / 2 [1/s2]
  double touch = 0;  ///< so far below a plane a vertex that leaves it may be [m]
};

/// The body of `motion`; of no vertices, known as a ball alone.
[[nodiscard]] FlyingBody flying_body(const Motion& motion, const Vec3& inertia, double radius,
                                     std::span<const Vec3> vertices);

/// Motion after `h` seconds of constant acceleration `a` of the centroid and no torque. Exact in
/// translation, angular momentum untouched.
[[nodiscard]] Motion fly(const Motion& motion, const Vec3& inertia, const Vec3& a, double h);

/// Motion of block b at `time`, between its local time and the end of its flight.
[[nodiscard]] Motion motion_at(const Scene& scene, const State& state, int b, double time);

/// A time for which a body that accelerates with `a` stays above the ground for sure, at most
/// `limit` and not beyond the grid's edge; 0 when none was found. Far above by bounds of the ground
/// below the path of its ball; near it by the planes of the triangles, cell by cell, which unknown
/// ground ends: until the ball and a vertex have reached one. Exact where it does not spin and
/// lands on a plane (nodes within 1e-9 of the cell size of one plane are in it).
[[nodiscard]] double free_time(const Ground& ground, const FlyingBody& body, const Vec3& a,
                               double limit);

}  // namespace talus
