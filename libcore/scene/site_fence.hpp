// libcore/scene/site_fence.hpp: public
// From a [fence.*] of the site file and its posts on the terrain to a fence of a run.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "scene/fence.hpp"
#include "site/site.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// The fence between `posts`, feet on the ground of `trn`, in local coordinates; `line` is its
/// index among the lines of the run. Its panels reach down to the ground where it dips between two
/// posts.
///
/// Throws InputError at `where`, with the place in map coordinates, for a fence that crosses or
/// touches itself, and for one whose panels hang above the ground by more than a quarter of the
/// height.
[[nodiscard]] StandingFence standing_fence(const FenceSettings& fence, const Trn& trn, int line,
                                           std::vector<Vec3> posts, const Where& where);

/// Throws InputError at `where`, with the place in map coordinates, for a line that crosses,
/// touches or comes back to itself; a closed one may end where it begins.
void check_no_crossing(const Trn& trn, const std::vector<Vec3>& points, const Where& where);

/// Throws InputError at `where` for a point with an elevation of its own (NaN: none) that lies
/// above the ground by more than a quarter of the fence's height. Local coordinates.
void check_feet(const FenceSettings& fence, const Trn& trn, const std::vector<Vec3>& points,
                const Where& where);

/// Whether a line lies within a tenth of a metre of another one all along, in plan; which end it
/// begins at and how many points it has do not matter.
[[nodiscard]] bool lies_along(const std::vector<Vec3>& line, const std::vector<Vec3>& other);

}  // namespace talus
