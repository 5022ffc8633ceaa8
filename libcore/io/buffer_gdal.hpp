// libcore/io/buffer_gdal.hpp: public
// What lies within a distance of a line or point.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

/// The area within `radius` > 0 of a line, or of a single point, as polygons of rings, not closed
/// by a repeated point; circles by 8 sides a quarter.
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> buffer_of(const std::vector<Vec2>& line,
                                                                    double radius);

}  // namespace talus
