// tools/site_places.hpp
// Places that a site file names, in the local coordinates of the terrain: corners and lines written
// in the file itself or in vector files beside it.
#pragma once

#include <string>
#include <vector>

#include "scene/site.hpp"
#include "store/crossings.hpp"
#include "terrain/trn.hpp"
#include "tool.hpp"

namespace talus {

/// Points of the site file (map coordinates in the CRS of [site]) as local ones; z NaN stays NaN.
/// `key` is where they stand. Throws InputError when they cannot be reprojected.
[[nodiscard]] std::vector<Vec3> local_points(Tool& tool, const Site& site, const Trn& ground,
                                             std::vector<Vec3> points, const std::string& key);

/// The line or lines of a [fence.*], with posts on the ground; several are named NAME.1, NAME.2 ...
/// Throws InputError for a fence without a line and as posts_on_ground().
[[nodiscard]] std::vector<RecordLine> fence_lines(Tool& tool, const Site& site, const Trn& trn,
                                                  const FenceSettings& fence);

/// A line and the section that it belongs to.
struct FenceLine {
  const FenceSettings* fence = nullptr;
  RecordLine line;
};

/// A fence that lies on another one all along is the same fence named twice, whichever end it
/// begins at. Throws InputError with both names and the place for two lines of one section and for
/// two active fences; warns of the rest, which count the same blocks.
void check_fences_apart(Tool& tool, const Site& site, const Trn& trn,
                        const std::vector<FenceLine>& lines);

}  // namespace talus
