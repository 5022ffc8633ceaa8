// tools/frame/failure_plane_choice.hpp
// The failure surface "daylighting" in words: which plane was taken, why other sets offer none, and
// what to change.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blocks/failure_plane.hpp"
#include "blocks/failure_wedge.hpp"
#include "site/site.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// The largest friction angle of the ground that the mass slides on: of the cells in the area, by
/// [ground.*] [rad].
[[nodiscard]] double friction_below(Tool& tool, const Site& site, const Trn& ground,
                                    const Area& area);
/// The same where the class of each cell is known; empty: one class.
[[nodiscard]] double friction_below(const Site& site, const Trn& ground, const Area& area,
                                    const std::vector<std::uint8_t>& classes);

/// The names of sets in "one" or "one + other".
[[nodiscard]] std::vector<std::string> names_joined(const std::string& said);

/// Throws InputError when [source] sliding_set names no set, or more than two.
void check_sliding_set(const Site& site, const FailurePlanes& found);

/// That no set offers a plane and no pair a wedge: of each why, and what to change.
[[nodiscard]] InputError no_plane_daylights(const Site& site, const FailurePlanes& found,
                                            const std::vector<FailureWedge>& wedges);

/// What a set needs for a mass to slide off on it: "dips 28 to 41 degrees towards 322 to 22"; that
/// there is no such dip, where the slope is no steeper than the friction angle.
[[nodiscard]] std::string what_would_go(const FailurePlanes& found);

/// A line for the slope and one for each set.
[[nodiscard]] std::string planes_text(const FailurePlanes& found, const Vec3& origin);

/// A line for each wedge, or for those alone that a mass can leave on; `taken` is marked.
[[nodiscard]] std::string wedges_text(const std::vector<FailureWedge>& wedges, bool all, int taken);

/// The plane or the wedge that was taken, in a line.
[[nodiscard]] std::string best_plane_text(const Json& planes);

/// `failure_planes` of a report, map coordinates. `wedge`: that the mass lies on; -1: none.
[[nodiscard]] Json planes_json(const FailurePlanes& found, const std::vector<FailureWedge>& wedges,
                               int wedge, const Vec3& origin);

}  // namespace talus
