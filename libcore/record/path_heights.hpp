// libcore/record/path_heights.hpp
// Greatest height of a path above the ground below it.
// in:    a piece of a block's path, straight in plan and a parabola in height; a TRN
// out:   heights of the centroid and of the block's top, in closed form over each triangle
#pragma once

#include <limits>

#include "terrain/trn.hpp"

namespace talus {

/// The path of a block's centroid and of its top above it: straight in plan, z(s) = from + (to -
/// from) s - sag s (1 - s) with sag = a_z h^2 / 2, s from 0 to 1.
struct HeightPath {
  Vec3 from, to;                    ///< centroid [m]
  double top_from = 0, top_to = 0;  ///< highest vertex above the centroid, linear in s [m]
  double sag = 0;                   ///< [m]
};
struct Heights {
  double centroid = std::numeric_limits<double>::quiet_NaN(),
         top = std::numeric_limits<double>::quiet_NaN();  ///< [m]
};
/// Greatest heights above the ground below the centroid for s from s_in to s_out. Exact for the
/// TRN's triangles. NaN where no ground is known below the path.
[[nodiscard]] Heights largest_heights(const Trn& trn, const HeightPath& path, double s_in,
                                      double s_out);

}  // namespace talus
