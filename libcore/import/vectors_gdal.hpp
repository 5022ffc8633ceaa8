// libcore/import/vectors_gdal.hpp: public
// Areas, lines and points from any vector source that OGR reads, in map coordinates of a wanted
// CRS.
#pragma once

#include <string>
#include <vector>

#include "base/types.hpp"
#include "import/layer_reading.hpp"
#include "import/request.hpp"

namespace talus {

struct RawLayer;

enum class VectorKind { points, lines, areas };

/// Purpose of a layer of a site.
[[nodiscard]] InputRole role_of(VectorKind kind);

struct VectorQuery {
  std::string path;  ///< with layers and a filter where need be: base/source_path.hpp
  VectorKind kind = VectorKind::areas;
  std::vector<std::string> fields = {};  ///< attributes to read of each point
};

/// Shapes of one kind. Single points each make a shape of one vertex. Areas are rings, even-odd:
/// polygons that overlap, touch or lie in one another are united before, so that a ring in a ring
/// is a hole of one polygon, never a polygon repeated. Closed lines are areas where a layer has no
/// polygon, and in a drawing always.
struct VectorShapes : LayerReading {
  std::vector<std::vector<Vec3>> shapes;  ///< points, lines, or closed rings without the last point
  std::vector<int> polygon;               ///< that a ring is of; empty: no areas       (n_shapes)
  /// Of points: the fields asked for, as text; empty where a layer does not have one or it is not
  /// set.                                                                     (n_shapes x n_fields)
  std::vector<std::vector<std::string>> attributes;
  std::vector<Doubt> doubts;  ///< places beside their CRS, a better operation
};

/// Throws InputError: source cannot be opened, no such layer or several that may be meant, nothing
/// of the kind in it, empty or missing geometries, polygons that are not sound, coordinates that
/// are not finite, do not fit their CRS (check_place) or cannot be reprojected, a drawing
/// that is not in metres. A source or target without a CRS is taken to be in the
/// other's.
[[nodiscard]] VectorShapes read_vectors(const VectorQuery& query, const std::string& crs_wkt);

/// Shapes of read_vectors() from a layer that went through all questions; the layer is spent.
[[nodiscard]] VectorShapes take_shapes(RawLayer& layer);

/// SHA-256 of all places in plan, and of the attributes.
[[nodiscard]] std::string digest_of(const VectorShapes& shapes);

}  // namespace talus
