// libcore/io/overview.hpp: public
// Smaller pictures of a raster that keep its extremes: means would hide the fastest block.
// in:    cells from north to south, west to east
// out:   fewer cells, each with one value of those below it
#pragma once

#include <cstdint>
#include <vector>

namespace talus {

/// Which value of the cells below it an overview's cell holds.
enum class OverviewValue : std::uint8_t {
  largest,
  smallest,            ///< e.g. of arrival times
  farthest_from_zero,  ///< of differences, which may be negative; with its sign
};

/// The raster in n_rows x n_cols cells, of which none is smaller than those of `value`; cells that
/// hold `nodata` count only where nothing else is.                             (n_rows x n_cols)
[[nodiscard]] std::vector<float> overview_of(const std::vector<float>& value, int from_rows,
                                             int from_cols, int n_rows, int n_cols, float nodata,
                                             OverviewValue keep);

}  // namespace talus
