// libcore/site/ground_classes.hpp: public
// Which cell of the terrain has which class of ground: the sections [ground.*] with their areas.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Of a raster of classes: nodata, and places outside of it.
inline constexpr std::int32_t no_class = std::numeric_limits<std::int32_t>::min();

/// Whether a section says where it holds by a polygon, in the site file or in a file of its own.
[[nodiscard]] bool has_area(const GroundSettings& ground);

/// Index of the section that holds where no other says that it does: it has neither polygon nor
/// raster values. Throws InputError when there are two of them, or none.
[[nodiscard]] int ground_elsewhere(const Site& site);

/// Index of the section of each value of the raster. Throws InputError for values that
/// are not whole numbers, that name two sections, and that are given without a raster.
[[nodiscard]] std::map<std::int32_t, int> classes_of_values(const Site& site);

/// Classes of the cells by the values of the raster at `path`, `elsewhere` where it has no_class.
/// Throws InputError for a value that no section names.                             (n_cells)
[[nodiscard]] std::vector<std::uint8_t> classes_of_cells(
    const std::vector<std::int32_t>& values, const std::map<std::int32_t, int>& class_of,
    int elsewhere, const std::string& path);

/// The area of one class: rings in local coordinates, even-odd, so that a ring in a ring is a hole.
struct GroundArea {
  int ground_class = 0;
  std::vector<std::vector<Vec2>> rings;  ///< without the first point at the end [m]
};

/// Gives the cells of `trn` whose centre lies inside an area the class of the last such area.
/// `classes` holds the rest.                                                        (n_cells)
void paint_areas(const Trn& trn, const std::vector<GroundArea>& areas,
                 std::vector<std::uint8_t>& classes);

}  // namespace talus
