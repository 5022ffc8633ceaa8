// Counts the convex features of a terrain and checks its elevations.
#include "terrain/trn.hpp"

#include "base/text.hpp"

namespace talus {

FeatureCounts feature_counts(const Trn& trn) {
  const std::int64_t m = trn.n_rows, n = trn.n_cols;
  return {m * n, (n - 1) * m + (m - 1) * n + (m - 1) * (n - 1), 2 * (m - 1) * (n - 1)};
}

void check_trn(const Trn& trn, const std::string& file) {
  const Where where{file};
  if (trn.n_rows < 2 || trn.n_cols < 2)
    throw InputError(where, "the grid has " + std::to_string(trn.n_rows) + " rows and " +
                                std::to_string(trn.n_cols) +
                                " columns of nodes, expected at least 2 x 2");
  if (!(trn.cell_size > 0) || !std::isfinite(trn.cell_size))
    throw InputError(where, "the cell size is " + text(trn.cell_size) + " m, expected above 0");
  if (trn.elevation.size() != static_cast<std::size_t>(feature_counts(trn).vertices))
    throw InputError(where, std::to_string(trn.elevation.size()) + " elevations for " +
                                std::to_string(feature_counts(trn).vertices) + " nodes");
  for (int triangle = 0; triangle < n_triangles(trn); ++triangle)
    if (is_known(trn, triangle)) return;
  throw InputError(where, "no triangle has three known corners: there is no ground",
                   "look at the raster's nodata value, or choose another window");
}

}  // namespace talus
