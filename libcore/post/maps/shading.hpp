// libcore/post/maps/shading.hpp
// The ground below a map: where it is known, and how it lies in the light.
#pragma once

#include <vector>

#include "record/passages.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// Whether the ground is known anywhere below a cell (its centre or a corner)   (n_rows x n_cols)
[[nodiscard]] std::vector<bool> known_cells(const Trn& trn, const PassageGrid& grid);

/// Brightness of the ground in squares, lit from the north-west at 45 degrees. It stays light, so
/// that colours above it are those of the legend: from 185 where no light falls to 255.
struct Shading {
  int n_rows = 0, n_cols = 0;
  std::vector<float> brightness;  ///< 0 to 255; NaN off the known ground        (n_rows x n_cols)
};
/// Of the squares of a grid, each at its centre.
[[nodiscard]] Shading shading_of(const Trn& trn, const PassageGrid& squares);

}  // namespace talus
