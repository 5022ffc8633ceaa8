// libcore/step/segment.hpp: public
// Motion of a block in a step: frames, passages and crossings are recorded from it.
#pragma once

#include "motion/motion.hpp"

namespace talus {

/// A piece of a block's motion with constant acceleration of the centroid, from one event to the
/// next: position(t) = start + v_start (t - t_start) + a (t - t_start)^2 / 2. A flight is one
/// piece.
struct Segment {
  int block = 0;
  bool flight = false;               ///< nothing was touched
  double t_start = 0, t_end = 0;     ///< [s]
  Motion start, end;                 ///< motion just after t_start and just before t_end
  Vec3 acceleration = Vec3::Zero();  ///< of the centroid, constant over the segment [m/s2]
};

}  // namespace talus
