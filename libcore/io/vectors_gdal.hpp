// libcore/io/vectors_gdal.hpp
// Areas, lines and points from any vector source that OGR reads, in map coordinates of a wanted
// CRS.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

enum class VectorKind { points, lines, areas };

/// What is asked for.
struct VectorQuery {
  std::string path;
  std::string layer;  ///< empty: the first layer that holds the kind
  std::string where;  ///< OGR attribute filter; empty: all
  VectorKind kind = VectorKind::areas;
};

/// Shapes of one kind. Single points each make a shape of one vertex.
struct VectorShapes {
  std::string layer;
  std::vector<std::vector<Vec3>> shapes;  ///< points, lines, or closed rings without the last point
  std::string source_crs;                 ///< WKT when the shapes were reprojected, else empty
};

/// Throws InputError: source cannot be opened, no such layer, nothing of the kind in it, empty or
/// missing geometries, coordinates that are not finite or cannot be reprojected. A source or target
/// without a CRS is taken to be in the other's.
[[nodiscard]] VectorShapes read_vectors(const VectorQuery& query, const std::string& crs_wkt);

}  // namespace talus
