// libcore/terrain/two_heights.hpp
// Points so near each other in plan that their heights should be one.
#pragma once

#include <cmath>

#include "base/types.hpp"

namespace talus {

/// Heights of one place that differ by less are one: the places of surveys and laser scans are
/// rounded to centimetres [m].
inline constexpr double same_place_noise_m = 0.5;

/// Points are in one place up to this distance in plan [m].
inline constexpr double one_place_m = 0.5;

/// Whether one of the heights is wrong, or a wall stands between: the points are no farther apart
/// than `near_m` [m], and the step from one to the other is above the noise and above five times
/// their distance (79 degrees, impossible_step()).
[[nodiscard]] inline bool are_two_heights(const Vec3& a, const Vec3& b, double near_m) {
  const double length = (a - b).head<2>().norm(), step = std::abs(a.z() - b.z());
  return length <= near_m && step > same_place_noise_m && step > 5 * length;
}

}  // namespace talus
