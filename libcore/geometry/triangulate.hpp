// libcore/geometry/triangulate.hpp: public
// Faces as triangles: fans where the face is convex, ears cut off where it is not.
#pragma once

#include <array>
#include <vector>

#include "geometry/polyhedron.hpp"

namespace talus {

/// Triangles of face f, oriented like it, indices into the body's vertices. A face without area, or
/// whose outline crosses itself, is cut up somehow: the number of triangles is always n - 2.
[[nodiscard]] std::vector<std::array<int, 3>> triangles_of_face(const Polyhedron& body, int f);

/// Whether the outline of face f turns in one sense only.
[[nodiscard]] bool is_convex_face(const Polyhedron& body, int f);

}  // namespace talus
