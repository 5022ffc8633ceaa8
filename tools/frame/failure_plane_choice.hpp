// tools/frame/failure_plane_choice.hpp
// Planes and wedges that a mass can leave on, in words and as JSON.
#pragma once

#include <string>
#include <vector>

#include "blocks/failure_plane.hpp"
#include "blocks/failure_wedge.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

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
