// libcore/terrain/elevation.hpp
// The heights that ground can have.
#pragma once

namespace talus {

/// The Earth keeps within, above and below sea level [m].
inline constexpr double highest_elevation = 12'000;

}  // namespace talus
