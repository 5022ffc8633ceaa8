// libcore/geometry/repeated_points.hpp: public
// Points of a layer that have the same place.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

/// Of each point the first one before it that is no further than `within` > 0 away [m] and does
/// not repeat another one itself; -1 where there is none. The heights of two points count where
/// both are known (not NaN). n log n.
[[nodiscard]] std::vector<int> repeated_points(const std::vector<Vec3>& points, double within);

}  // namespace talus
