// libcore/terrain/elevation.hpp: public
// The heights that ground can have.
#pragma once

namespace talus {

/// No summit is higher; ground keeps within, above and below sea level [m].
inline constexpr double highest_elevation = 9'000;

/// No land lies lower: the shore of the Dead Sea is at about -440 m [m].
inline constexpr double lowest_land = -500;

/// Values that mean an unknown height in so many files that none of them is taken for a height.
[[nodiscard]] constexpr bool is_usual_nodata(double value) {
  return value == -9999 || value == -32767 || value == -32768;
}

}  // namespace talus
