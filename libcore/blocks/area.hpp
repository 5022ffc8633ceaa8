// libcore/blocks/area.hpp: public
// Areas in plan: rings, points inside them, checks of rings.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

namespace talus {

/// Closed rings, first point not repeated; a point in an odd number of rings is inside.
struct Area {
  std::vector<std::vector<Vec2>> rings;  ///< local x, y [m]
};

/// The area with corners that follow themselves in a ring (also as last and first) taken once.
[[nodiscard]] Area without_repeated_corners(Area area);

/// Inside or on the border.
[[nodiscard]] bool contains(const Area& area, const Vec2& point);
/// Of one of its rings: it lies in an odd number of the others.
[[nodiscard]] bool is_hole(const Area& area, const std::vector<Vec2>& ring);
[[nodiscard]] double area_of(const Area& area);  ///< rings taken with even-odd sign [m2]
/// Throws InputError when a ring has fewer than three points or no area, or when rings cross
/// themselves or each other, saying where in map coordinates.
void check_area(const Area& area, const Vec3& origin, const Where& where);

}  // namespace talus
