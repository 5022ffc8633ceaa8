// libcore/scene/ground_classes.hpp
// Which cell of the terrain has which class of ground: the sections [ground.*] with their areas.
#pragma once

#include <cstdint>
#include <vector>

#include "terrain/trn.hpp"

namespace talus {

/// The area of one class: rings in local coordinates, even-odd, so that a ring in a ring is a hole.
struct GroundArea {
  int ground_class = 0;
  std::vector<std::vector<Vec2>> rings;  ///< without the first point at the end [m]
};

/// Gives the cells of `trn` whose centre lies inside an area the class of the last such area.
/// `classes` holds the others'.                                                     (n_cells)
void paint_areas(const Trn& trn, const std::vector<GroundArea>& areas,
                 std::vector<std::uint8_t>& classes);

}  // namespace talus
