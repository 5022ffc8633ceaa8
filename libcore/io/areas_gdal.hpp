// libcore/io/areas_gdal.hpp: public
// Polygons as they are read: each one is sound on its own, and overlapping ones are one area.
// in:    polygons of a vector source, or the corners of one
// out:   polygons that share no ground
// refs:  OGC Simple Features (validity), GEOS through OGR
#pragma once

#include <memory>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

class OGRPolygon;

namespace talus {

/// Throws InputError at `where`, with the reason and the place in the polygon's coordinates, when
/// the polygon crosses or touches itself, has no area, or has a hole outside of its outline.
void check_polygon(const OGRPolygon& polygon, const Where& where);

/// As check_polygon() for a polygon given by the corners of its outline.
void check_polygon(const std::vector<Vec2>& corners, const Where& where);

/// Result of unite_polygons().
struct Uniting {
  int n_united = 0;  ///< polygons that overlapped or touched another one
  int n_made = 0;    ///< polygons made of them
};

/// Makes one polygon of those that overlap, touch or lie in one another, so that no place is in
/// two. A polygon apart from the rest stays as it is, with all its points. All must be sound
/// (check_polygon). Throws InputError at `where` when the union fails.
Uniting unite_polygons(std::vector<std::unique_ptr<OGRPolygon>>& polygons, const Where& where);

}  // namespace talus
