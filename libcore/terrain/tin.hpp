// libcore/terrain/tin.hpp: public
// Triangulated irregular network: the form of contours before they are gridded.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// Points and triangles, counter-clockwise seen from above.
struct Tin {
  Vec3 origin = Vec3::Zero();                 ///< map coordinates of the local zero [m]
  std::string crs_wkt;                        ///< or the EPSG:code of a PLY; empty when unknown
  std::vector<Vec3> points;                   ///< relative to `origin` [m]          (n_points)
  std::vector<std::array<int, 3>> triangles;  ///< indices into `points`           (n_triangles)
  bool is_judged = false;       ///< talus-tin has judged these very points and triangles
  std::string accepted_doubts;  ///< places whose heights the user accepted; empty: none
};

}  // namespace talus
