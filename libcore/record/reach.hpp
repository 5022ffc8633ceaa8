// libcore/record/reach.hpp: public
// How far the blocks of a run came, as it is kept where the frames between start and end are not.
// Definitions: docs/reference/formats.md#run-out
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// H and L between two points, and Eq. (29): beta = atan(H / L).
struct ReachLine {
  double height = 0;  ///< H, positive downwards [m]
  double path = 0;    ///< L along the path, in plan [m]
  double chord = 0;   ///< L straight from end to end, in plan [m]
  [[nodiscard]] double path_angle() const { return angle_of(path); }    ///< [rad]; NaN: no length
  [[nodiscard]] double chord_angle() const { return angle_of(chord); }  ///< [rad]; NaN: no length

 private:
  [[nodiscard]] double angle_of(double length) const {
    return length > 0 ? std::atan2(height, length) : std::numeric_limits<double>::quiet_NaN();
  }
};

/// Part of a run's reach that only its frames tell.
struct RunReach {
  double tolerance = 0;            ///< of the simplified paths that lengths are measured on [m]
  std::vector<ReachLine> block;    ///< of the centroids                           (n_blocks)
  std::vector<double> max_speed;   ///< over all steps, or the frames without passages [m/s]
  std::vector<double> max_energy;  ///< of translation and rotation, over the same [J]
  std::vector<Vec3> streamline;    ///< top, the toe block's path on the ground, toe, local [m]
  ReachLine centre_of_mass;        ///< of all blocks
};

}  // namespace talus
