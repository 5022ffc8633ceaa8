// libcore/terrain/terrain_error.hpp: public
// A terrain as it may be, given how well its elevations are known.
// in:    the root of the mean square of their error, the distance over which errors are alike
// out:   the terrain with one such error, the same for the same seed
#pragma once

#include <cstdint>

#include "terrain/trn.hpp"

namespace talus {

/// Each node moved by a normal error of standard deviation `rmse` [m]. Errors at a distance d are
/// correlated by exp(-(d / correlation)^2); `correlation` > 0 [m]. The error of a place depends on
/// the seed and its map coordinates in cells, not on the window. Unknown nodes stay unknown.
[[nodiscard]] Trn with_error(const Trn& trn, double rmse, double correlation, std::uint64_t seed);

}  // namespace talus
