// libcore/terrain/tin_mesh.hpp
// From a triangulation to a TIN: cut to a boundary, points that no triangle uses left out.
#pragma once

#include <vector>

#include "terrain/contours.hpp"
#include "terrain/tin.hpp"
#include "terrain/triangulate.hpp"

namespace talus {

/// Drops the triangles whose centroid lies outside of the rings (even-odd rule: a ring in a ring is
/// a hole). Without rings nothing is dropped.
void cut_to_rings(const std::vector<std::vector<Vec2>>& rings, TriangleMesh& mesh);

/// The mesh as a TIN in the map's place, without points that stand in no triangle. Uses up the
/// mesh.
[[nodiscard]] Tin to_tin(TriangleMesh mesh, const ContourMap& map);

}  // namespace talus
