// libcore/base/units.hpp: public
// Units of the inputs and results, in those of the library: 30 * degree is an angle, and
// angle / degree a number of degrees.
#pragma once

#include <cmath>
#include <numbers>

namespace talus {

inline constexpr double degree = std::numbers::pi / 180;  ///< [rad]

/// Slope or friction coefficient of an angle in degrees [-].
[[nodiscard]] inline double tangent_of_degrees(double angle) { return std::tan(angle * degree); }

}  // namespace talus
