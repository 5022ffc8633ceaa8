// libcore/store/motion.hpp
// A block's motion at any moment of a segment, and what is recorded of it.
// in:    segments of the solver (dda/work.hpp), pieces of constant acceleration of the centroid
// out:   motion, energies; the same numbers for frames, passages and crossings
#pragma once

#include <vector>

#include "dda/rotation.hpp"
#include "dda/scene.hpp"
#include "dda/work.hpp"

namespace talus {

/// A flight is followed in strides in which its spin turns by less than this [rad].
inline constexpr double flight_stride = 0.25;

/// From above, by how much a body with principal moments `inertia` turns in a flight [rad].
[[nodiscard]] double flight_turn(const Segment& segment, const Vec3& inertia);

/// Follows one segment after the other; what a flight's spin takes to compute is kept for as long
/// as the segment is followed, and the buffer for the next one.
///
/// A flight is followed exactly in translation, and in strides in spin, whose bits do not depend on
/// the times asked for. Between two steps with contact the centroid keeps the segment's
/// acceleration, the attitude turns evenly (slerp), velocity and angular momentum go linearly. At
/// both ends the solver's own bits come back.
class SegmentMotion {
 public:
  /// `segment` and `inertia` must outlive the calls of at().
  void follow(const Segment& segment, const Vec3& inertia);
  [[nodiscard]] const Segment& segment() const { return *segment_; }
  /// Motion at `t`, t_start <= t <= t_end.
  [[nodiscard]] Motion at(double t);

 private:
  [[nodiscard]] Motion in_flight(double elapsed);
  const Segment* segment_ = nullptr;
  const Vec3* inertia_ = nullptr;
  double stride_ = 0;            // of the spin [s]
  std::vector<Quat> attitudes_;  // after 0, 1, 2 ... strides, as far as they were needed
};

/// SegmentMotion at one time.
[[nodiscard]] Motion motion_at(const Segment& segment, const Vec3& inertia, double t);

[[nodiscard]] double translational_energy(double mass, const Vec3& velocity);  ///< m v^2 / 2 [J]
/// omega . L / 2 [J].
[[nodiscard]] double rotational_energy(const Motion& motion, const Vec3& inertia);

}  // namespace talus
