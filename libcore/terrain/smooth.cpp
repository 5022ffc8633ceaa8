// Smooths the ground over features as small as a cell.
#include "terrain/smooth.hpp"

#include <algorithm>
#include <cmath>

namespace talus {

Trn smoothed(const Trn& trn) {
  Trn result = trn;
  for (int r = 0; r < trn.n_rows; ++r)
    for (int c = 0; c < trn.n_cols; ++c) {
      double& z = result.elevation[node_index(trn, r, c)];
      if (std::isnan(z)) continue;
      double sum = 0;
      int n = 0;
      for (int i = std::max(0, r - 1); i <= std::min(trn.n_rows - 1, r + 1); ++i)
        for (int k = std::max(0, c - 1); k <= std::min(trn.n_cols - 1, c + 1); ++k) {
          const double beside = trn.elevation[node_index(trn, i, k)];
          if (std::isnan(beside)) continue;
          sum += beside;
          ++n;
        }
      z = sum / n;
    }
  return result;
}

}  // namespace talus
