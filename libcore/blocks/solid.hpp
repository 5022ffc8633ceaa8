// libcore/blocks/solid.hpp: public
// From a surface to a body: checked for being a solid, taken apart into convex parts.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "blocks/block_set.hpp"

namespace talus {

/// The surface with faces in one plane joined into one polygon (where that is a disc), and vertices
/// in the middle of straight edges removed. Needs a closed oriented surface.
[[nodiscard]] Polyhedron with_joined_faces(const Polyhedron& surface);

/// The same body with vertices in the order of their coordinates, faces beginning at their first
/// vertex and in the order of their vertices: independent of how it was made.
[[nodiscard]] Polyhedron in_standard_order(const Polyhedron& body);

/// Largest distance of a corner of face f from the face's plane [m].
[[nodiscard]] double unevenness(const Polyhedron& body, int f);

/// The surface with faces that are less even than `tolerance` [m] cut into triangles.
[[nodiscard]] Polyhedron with_flat_faces(const Polyhedron& body, double tolerance);

/// Two faces that cut through or touch each other away from common vertices; nothing when there are
/// none. Exact for the given coordinates.
[[nodiscard]] std::optional<std::pair<int, int>> find_self_intersection(const Polyhedron& surface);

/// Of two convex bodies [m3].
[[nodiscard]] double common_volume(const Polyhedron& one, const Polyhedron& other);

/// Smallest convex body around the points, in standard order; without faces when they are flat. Its
/// faces are triangles; exact predicates.
[[nodiscard]] Polyhedron convex_hull(const std::vector<Vec3>& points, int tag);

/// Convex parts that fill a closed, non-convex body with flat faces, by a binary tree of its faces'
/// planes; then joined where the union is convex again. Throws InputError when the parts do not add
/// up to the volume of the body to 1e-6, or the body has more than 20,000 faces.
[[nodiscard]] std::vector<Polyhedron> convex_parts(const Polyhedron& body, const Where& where);

/// A surface as a body of material 0, at rest. Polygons that are not flat, as rounded coordinates
/// leave them, say how well the surface is known: a body that is convex but for that becomes its
/// convex hull; of other bodies such polygons become triangles. Refuses with InputError a surface
/// that is open, not a manifold, flat, not finite or cuts through itself, saying where; a surface
/// that is inside-out is turned, and `was_turned` says so.
[[nodiscard]] Body make_solid(const Polyhedron& surface, const Where& where, bool& was_turned);

/// The same of surfaces that are the convex parts of one body, kept as they are. Refuses also parts
/// that are not convex, and parts that overlap by more than 1e-6 of the body's volume, which would
/// count twice. Faces that other parts cover are face_internal.
[[nodiscard]] Body make_solid_of_parts(const std::vector<Polyhedron>& parts, const Where& where,
                                       bool& was_turned);

}  // namespace talus
