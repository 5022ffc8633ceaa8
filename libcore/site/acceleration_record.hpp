// libcore/site/acceleration_record.hpp: public
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

/// amplitude sin(angular_frequency (t - start)) from `start` to `end`, nothing before and after.
struct HarmonicMotion {
  Vec3 amplitude = Vec3::Zero();  ///< x east, y north, z up; zero: none [m/s2]
  double angular_frequency = 0;   ///< [rad/s]
  double start = 0, end = 0;      ///< [s]
};

/// Acceleration of the ground: samples, linear in between, and a harmonic part. The scene is
/// computed in the ground's frame.
struct AccelerationRecord {
  std::vector<double> time;        ///< increasing [s]                    (n_samples)
  std::vector<Vec3> acceleration;  ///< x east, y north, z up [m/s2]      (n_samples)
  HarmonicMotion harmonic;
};

/// Whether the ground moves at all.
[[nodiscard]] inline bool shakes(const AccelerationRecord& base) {
  return !base.time.empty() || !base.harmonic.amplitude.isZero(0);
}

}  // namespace talus
