// libcore/site/acceleration_record.hpp: public
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

/// Acceleration of the ground, linear between samples; the scene is computed in the ground's frame.
struct AccelerationRecord {
  std::vector<double> time;        ///< increasing [s]                    (n_samples)
  std::vector<Vec3> acceleration;  ///< x east, y north, z up [m/s2]      (n_samples)
};

}  // namespace talus
