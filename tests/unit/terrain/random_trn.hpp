// tests/unit/terrain/random_trn.hpp
// Grids for the terrain tests: rough, off the origin, with an awkward cell size.
#pragma once

#include <limits>

#include "base/random.hpp"
#include "terrain/trn.hpp"

namespace talus_test {

/// Uncorrelated node elevations in 0..relief; each node unknown with probability `unknown`.
inline talus::Trn random_trn(talus::Random& random, int n_rows, int n_cols, double relief,
                             double unknown = 0) {
  talus::Trn trn;
  trn.n_rows = n_rows;
  trn.n_cols = n_cols;
  trn.cell_size = 4.99768;
  trn.node0 = {-31.25, 77.7};
  for (int i = 0; i < n_rows * n_cols; ++i) {
    const double z = random.uniform(0, relief);
    trn.elevation.push_back(random.uniform() < unknown ? std::numeric_limits<double>::quiet_NaN()
                                                       : z);
  }
  return trn;
}

/// A grid whose nodes lie on z = z0 + gx x + gy y.
inline talus::Trn planar_trn(int n_rows, int n_cols, double cell_size, double gx, double gy) {
  talus::Trn trn;
  trn.n_rows = n_rows;
  trn.n_cols = n_cols;
  trn.cell_size = cell_size;
  for (int r = 0; r < n_rows; ++r)
    for (int c = 0; c < n_cols; ++c)
      trn.elevation.push_back(1000 + gx * c * cell_size - gy * r * cell_size);
  return trn;
}

}  // namespace talus_test
