// libcore/terrain/smooth.hpp: public
// The ground without features as small as a cell.
#pragma once

#include "terrain/trn.hpp"

namespace talus {

/// Each known node at the mean of the known ones among itself and its eight neighbours; unknown
/// nodes stay unknown.
[[nodiscard]] Trn smoothed(const Trn& trn);

}  // namespace talus
