// libcore/terrain/outliers.hpp: public
// Lines and points of a contour map whose heights do not go with those around them: a wrong label,
// a missing one read as 0, a spot height in other units.
// in:    the triangulation of a map; which line each point is of
// out:   lines and points in doubt, with the heights around them
// method: docs/tools/talus-tin.md, "Heights in doubt"
#pragma once

#include <vector>

#include "terrain/triangulate.hpp"

namespace talus {

/// Which line each point of a mesh is of: contours first, then breaklines and spot heights.
struct LinesOfPoints {
  std::vector<int> line;     ///< (n_points of the cleaned map)
  int n_contour_points = 0;  ///< points from here on were measured
  int n_lines = 0;
};

struct Outlier {
  int line = 0;
  Vec3 place = Vec3::Zero();   ///< one of its points [m]
  double low = 0, high = 0;    ///< of the contours beside it [m]
  bool is_impossible = false;  ///< ground is never so far off so near, see find_outliers
};

/// Contours that are above all contours beside them, or below them all, by more than one and a half
/// steps. A step is `interval`, or the height between the contours beside and those beyond where
/// that is more. "All" is four in five of the triangles' edges to contours of another height: the
/// next piece of a broken line has the right height and does not hide the fault.
///
/// Measured points that lie more than two steps above the highest contour beside them or below the
/// lowest. A step is `interval`, or the difference of those two where that is more.
///
/// Spot heights (lines of one measured point) up to 0.5 m from another one that is lower, or from
/// contours none of which is within half an interval, where the step is above 0.5 m and 79 degrees.
///
/// A finding is impossible where four in five of those edges are higher than 200 m and than
/// five times their length: steeper than 79 degrees all around, as cells of an undeclared value in
/// a raster (lone_levels.hpp).
///
/// Ascending by line, each line once.
[[nodiscard]] std::vector<Outlier> find_outliers(const TriangleMesh& mesh,
                                                 const LinesOfPoints& lines, double interval);

}  // namespace talus
