// libcore/motion/motion.hpp: public
// How a body moves: its pose, velocity and spin.
#pragma once

#include "motion/pose.hpp"

namespace talus {

/// Motion of one block at its own time.
struct Motion {
  Pose pose;                             ///< centroid [m], attitude
  Vec3 velocity = Vec3::Zero();          ///< of the centroid [m/s]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the centroid, local axes [kg m2/s]
};

}  // namespace talus
