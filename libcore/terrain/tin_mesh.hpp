// libcore/terrain/tin_mesh.hpp: public
// From a triangulation to a TIN: cut to a boundary, points that no triangle uses left out.
#pragma once

#include <string>
#include <vector>

#include "terrain/contours.hpp"
#include "terrain/tin.hpp"
#include "terrain/triangulate.hpp"

namespace talus {

/// Throws InputError naming `source`, with the place in map coordinates, where the edges of a
/// boundary polygon cross each other. They may touch; polygons may overlap.
void check_boundary(const ContourMap& map, const std::string& source);

/// Drops the triangles whose centroid lies in none of the polygons. Without rings nothing is
/// dropped.
void cut_to_rings(const std::vector<BoundaryRing>& rings, TriangleMesh& mesh);

/// Area inside the polygons, by 300 x 300 places in the rectangle that holds them [m2].
[[nodiscard]] double area_of(const std::vector<BoundaryRing>& rings);

/// The mesh as a TIN in the map's place, without points that belong to no triangle. Uses up the
/// mesh.
[[nodiscard]] Tin to_tin(TriangleMesh mesh, const ContourMap& map);

}  // namespace talus
