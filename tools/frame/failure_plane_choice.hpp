// tools/frame/failure_plane_choice.hpp
// The failure surface "daylighting" in words: which plane was taken, why other sets offer none, and
// what to change.
#pragma once

#include <string>
#include <vector>

#include "blocks/failure_plane.hpp"
#include "site/site.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// The largest friction angle of the ground that the mass slides on: of the cells in the area, by
/// [ground.*] [rad].
[[nodiscard]] double friction_below(Tool& tool, const Site& site, const Trn& ground,
                                    const Area& area);

/// Throws InputError when [source] sliding_set names no set.
void check_sliding_set(const Site& site, const FailurePlanes& found);

/// That no set offers a plane: of each set why, and what to change.
[[nodiscard]] InputError no_plane_daylights(const Site& site, const FailurePlanes& found);

/// What a set needs for a mass to slide off on it: "dips 28 to 41 degrees towards 322 to 22"; that
/// there is no such dip, where the slope is no steeper than the friction angle.
[[nodiscard]] std::string what_would_go(const FailurePlanes& found);

/// A line for the slope and one for each set.
[[nodiscard]] std::string planes_text(const FailurePlanes& found, const Vec3& origin);

/// The plane that was taken, in a line.
[[nodiscard]] std::string best_plane_text(const Json& planes);

/// `failure_planes` of a report, map coordinates.
[[nodiscard]] Json planes_json(const FailurePlanes& found, const Vec3& origin);

}  // namespace talus
