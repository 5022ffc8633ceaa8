// libcore/geometry/convex_outline.hpp: public
// Convex outline of points in the plane. Andrew 1979 (monotone chain).
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

/// Corners of the convex hull, counter-clockwise from the westernmost, without points on its sides;
/// the points themselves, sorted, where they are fewer than three.
[[nodiscard]] std::vector<Vec2> convex_outline(std::vector<Vec2> points);

}  // namespace talus
