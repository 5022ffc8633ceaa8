// libcore/record/motion.hpp: public
// A block's motion at any moment of a segment, and the quantities recorded of it.
// in:    segments of the solver (step/segment.hpp), pieces of constant acceleration of the centroid
// out:   motion, energies; the same numbers for frames, passages and crossings
#pragma once

#include "motion/free_spin.hpp"
#include "step/segment.hpp"

namespace talus {

/// From above, by how much a body with principal moments `inertia` turns in a flight [rad].
[[nodiscard]] double flight_turn(const Segment& segment, const Vec3& inertia);

/// Follows one segment after the other; the closed form of a flight's spin is made once a segment,
/// when it is first asked for.
///
/// A flight is followed exactly, in translation and in spin. Between two steps with contact the
/// centroid keeps the segment's acceleration, the attitude turns evenly (slerp), velocity and
/// angular momentum are interpolated linearly. At both ends the solver's own bits come back; in
/// between they do not depend on earlier calls.
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
  FreeSpin spin_;
  bool has_spin_ = false;
};

/// SegmentMotion at one time.
[[nodiscard]] Motion motion_at(const Segment& segment, const Vec3& inertia, double t);

[[nodiscard]] double translational_energy(double mass, const Vec3& velocity);  ///< m v^2 / 2 [J]
/// omega . L / 2 [J].
[[nodiscard]] double rotational_energy(const Motion& motion, const Vec3& inertia);

}  // namespace talus
