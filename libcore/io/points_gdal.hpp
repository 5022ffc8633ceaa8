// libcore/io/points_gdal.hpp
// Points with a height, from any vector source: what a terrain is held against.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

struct MapPoints {
  std::vector<Vec3> points;  ///< map coordinates [m]                                  (n_points)
  std::string source_crs;    ///< WKT of the source when the points were reprojected, else empty
};

/// All points of the first layer of `path`, single or multiple, in `crs_wkt`: points in another
/// CRS are reprojected (heights stay). A missing CRS, of the source or in `crs_wkt`, means the
/// same one. Throws InputError when the source cannot be opened, has no layer or no point, holds
/// other geometries, or a point lacks a height or a finite place.
[[nodiscard]] MapPoints read_points(const std::string& path, const std::string& crs_wkt);

}  // namespace talus
