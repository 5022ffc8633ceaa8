// libcore/terrain/trn.hpp
// Terrain as a triangulated regular network (TRN): one elevation a node, two triangles a cell.
// in:    elevation raster written by talus-trn
// paper: Zhang et al. 2018, Sect. 3 (TRN) and Eq. (4)-(7)
//
// Row r counts southwards from the northernmost row, column c eastwards. Cell (r, c) has node (r,
// c) at its north-west corner and is cut along the diagonal (r, c) - (r + 1, c + 1), as in the
// paper. Triangles are never stored: triangle 2 [(n_cols - 1) r + c] is the lower left one, (r, c)
// (r + 1, c) (r + 1, c + 1), and the next, odd one the upper right, (r, c) (r + 1, c + 1) (r, c +
// 1).
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

struct Trn {
  int n_rows = 0;              ///< nodes from north to south, the paper's m
  int n_cols = 0;              ///< nodes from west to east, the paper's n
  double cell_size = 0;        ///< Delta, > 0 [m]
  Vec2 node0 = Vec2::Zero();   ///< local x, y of node (0, 0), the north-west one [m]
  Vec3 origin = Vec3::Zero();  ///< map coordinates of the local zero [m]
  std::string crs_wkt;         ///< projected, metres; empty when unknown
  std::vector<double>
      elevation;  ///< local z at [r * n_cols + c], NaN = unknown [m]  (n_rows * n_cols)
};

}  // namespace talus
