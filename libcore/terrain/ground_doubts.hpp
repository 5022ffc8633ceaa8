// libcore/terrain/ground_doubts.hpp: public
// Nodes of a terrain whose neighbours contradict them: remains of undeclared nodata, spikes, pits,
// ground that is too low for any land.
// in:    a TRN
// out:   places to look at
// method: docs/guide/limits.md, "Rasters"
#pragma once

#include <string>
#include <vector>

#include "base/doubt.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Height between nodes side by side that ground seldom has [m]: 20 m, and 5 cells where those are
/// more.
[[nodiscard]] double doubtful_step(double cell_size);

/// A level area, by its first node.
inline constexpr const char* level_area = "level area";

/// Each node once, row by row; none in most sound terrain:
///  sunken node: below lowest_land, which is refused
///  level area: two nodes and more of one value, off most of their neighbours by doubtful_step()
///  rim node: beside unknown ground, off the node further in by that: blended with nodata
///  step: off a node beside by impossible_step()
///  seam: one step along a straight line of nodes (seams.hpp), by the middle of its line
[[nodiscard]] std::vector<Doubt> find_ground_doubts(const Trn& trn, const std::string& source);

}  // namespace talus
