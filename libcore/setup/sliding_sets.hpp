// libcore/setup/sliding_sets.hpp: public
// The failure surface "daylighting": which joint sets it may lie on, why the rest offer none, and
// the remedy.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "blocks/failure_plane.hpp"
#include "blocks/failure_wedge.hpp"
#include "site/site.hpp"

namespace talus {

/// The largest friction angle of the ground that the mass slides on: of the cells in the area, by
/// [ground.*] [rad]. `classes`: of each cell; empty: one class.
[[nodiscard]] double friction_below(const Site& site, const Trn& ground, const Area& area,
                                    const std::vector<std::uint8_t>& classes);

/// The names of sets in "one" or "one + other".
[[nodiscard]] std::vector<std::string> names_joined(const std::string& said);

/// Throws InputError when [source] sliding_set names no set, or more than two.
void check_sliding_set(const Site& site, const FailurePlanes& found);

/// That no set offers a plane and no pair a wedge: the reason for each, and the remedy.
[[nodiscard]] InputError no_plane_daylights(const Site& site, const FailurePlanes& found,
                                            const std::vector<FailureWedge>& wedges);

/// Dip that a set needs for a mass to slide off on it: "dips 28 to 41 degrees towards 322 to 22";
/// that such a dip does not exist, where the slope is not steeper than the friction angle.
[[nodiscard]] std::string what_would_go(const FailurePlanes& found);

/// A number with at most one decimal ("28.4").
[[nodiscard]] std::string tenths(double value);

/// "bedding (30 degrees towards 340)".
[[nodiscard]] std::string named_attitude(const FailurePlane& plane);

}  // namespace talus
