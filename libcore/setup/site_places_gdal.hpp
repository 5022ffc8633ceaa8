// libcore/setup/site_places_gdal.hpp: public
// Places that a site file names, in the local coordinates of the terrain: corners and lines written
// in the file itself or in vector files beside it.
#pragma once

#include <string>
#include <vector>

#include "base/input_log.hpp"
#include "record/fence_lines.hpp"
#include "record/object_hits.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// The line or lines of a [fence.*], with posts on the ground; several are named NAME.1, NAME.2 ...
/// Throws InputError for a fence with two sources of its line and as
/// lines_of_fence().
[[nodiscard]] std::vector<RecordLine> fence_lines(InputLog& log, const Site& site, const Trn& trn,
                                                  const FenceSettings& fence);

/// The objects of all [object.*], with the roofs of galleries over them. Throws InputError for one
/// without a place or with several, lines without a width, points without a radius, outlines that
/// cross themselves, and an object that lies outside of the known terrain; warns of one that lies
/// partly outside.
[[nodiscard]] std::vector<RecordObject> site_objects(InputLog& log, const Site& site,
                                                     const Trn& trn);

/// The area of an object: its outlines, and the ground within its radius of lines and points;
/// polygon, ring, points, local [m].
[[nodiscard]] std::vector<std::vector<std::vector<Vec2>>> polygons_of(const RecordObject& object);

/// As check_fences_apart() of record/fence_lines.hpp, whose sentences become warnings; and the same
/// for fences that share more than two metres of ground.
void check_fences_apart(InputLog& log, const Site& site, const Trn& trn,
                        const std::vector<FenceLine>& lines);

}  // namespace talus
