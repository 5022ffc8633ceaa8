// libcore/record/fence_lines.hpp: public
// From the corners of a [fence.*] to the lines that a run watches: posts on the ground, names, and
// fences that lie on one another.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "record/crossings.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// The place of a section in the site file.
[[nodiscard]] Where where_of_fence(const std::string& site_file, const FenceSettings& fence);

/// The lines of a section whose corners are `corners`, local coordinates, z NaN: on the ground.
/// Several are named NAME.1, NAME.2 ... Throws InputError for a section without a line and as
/// check_feet() and posts_on_ground().
[[nodiscard]] std::vector<RecordLine> lines_of_fence(const FenceSettings& fence, const Trn& trn,
                                                     const std::vector<std::vector<Vec3>>& corners,
                                                     const Where& where);

/// A line and the section that it belongs to.
struct FenceLine {
  const FenceSettings* fence = nullptr;
  RecordLine line;
};

/// A fence that lies on another one all along is the same fence named twice, whichever end it
/// begins at. Throws InputError with both names and the place for two lines of one section and for
/// two active fences; returns a sentence for each of the rest, which count the same blocks.
[[nodiscard]] std::vector<std::string> check_fences_apart(const std::string& site_file,
                                                          const Trn& trn,
                                                          const std::vector<FenceLine>& lines);

}  // namespace talus
