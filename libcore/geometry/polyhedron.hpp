// libcore/geometry/polyhedron.hpp: public
// Closed polyhedra as plain data: vertices and polygons, their exact moments, their checks, and the
// cutting of convex ones by a plane.
// in:    nothing but coordinates; keep them near the local origin, never absolute map coordinates
// theory: docs/theory/theory.md 1.3 (moments by the simplex integrals)
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "geometry/plane.hpp"

namespace talus {

/// Polygons are counter-clockwise seen from outside; each carries its origin.
struct Polyhedron {
  std::vector<Vec3> vertices;      ///< [m]                                         (n_vertices)
  std::vector<int> face_begin{0};  ///< first entry of face f in `face_vertices`   (n_faces + 1)
  std::vector<int> face_vertices;  ///< indices into `vertices`, face by face
  std::vector<int> face_tag;       ///< e.g. the joint set of the face             (n_faces)
};

[[nodiscard]] inline int n_faces(const Polyhedron& body) {
  return static_cast<int>(body.face_begin.size()) - 1;
}
/// Vertex indices of face f.
[[nodiscard]] std::span<const int> face(const Polyhedron& body, int f);
void add_face(Polyhedron& body, std::span<const int> vertices, int tag);

/// Vector area of face f by Newell's sum: length = area [m2], direction = outward normal.
[[nodiscard]] Vec3 face_area_vector(const Polyhedron& body, int f);
[[nodiscard]] double face_area(const Polyhedron& body, int f);
/// Unit outward normal; zero for a face without area.
[[nodiscard]] Vec3 face_normal(const Polyhedron& body, int f);
/// Centre of area of a planar face, convex or not [m]; the vertex mean when it has no area.
[[nodiscard]] Vec3 face_centroid(const Polyhedron& body, int f);

/// An edge between vertices a -> b as face `left` runs through it; `right` runs through b -> a.
struct PolyhedronEdge {
  int a = 0, b = 0;
  int left = -1, right = -1;  ///< -1: no such face, the surface is open there
};
/// Each undirected edge once, sorted by (min, max) vertex. An edge with more than one face a side
/// is listed once for each pair of faces that bound the same wedge of material: where bodies that
/// share vertices touch along an edge, each keeps to itself.
[[nodiscard]] std::vector<PolyhedronEdge> edges(const Polyhedron& body);
[[nodiscard]] double shortest_edge(const Polyhedron& body);  ///< [m]; infinity without edges

/// Volume [m3], centroid [m] and central second moments S = integral of (x - c)(x - c)^T [m5].
struct Moments {
  double volume = 0;
  Vec3 centroid = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};
/// Exact integrals over the fan tetrahedra from a point near the body (theory 1.3). A body turned
/// inside out has a negative volume; without volume the centroid is the vertex mean and S is zero.
[[nodiscard]] Moments moments(const Polyhedron& body);
/// Moments of two bodies that do not overlap, taken as one.
[[nodiscard]] Moments joined(const Moments& one, const Moments& other);

/// Edges of the box with the same second moments, longest first; 0 without volume [m].
[[nodiscard]] Vec3 extents(const Moments& moments);

/// Faults of a surface, worst first.
enum class SurfaceFault {
  none,
  bad_index,     ///< a face names a vertex that does not exist, or has fewer than three
  repeated,      ///< a face names the same vertex twice in a row
  open,          ///< an edge has one face only: a hole
  not_manifold,  ///< an edge has more than two faces
  not_oriented,  ///< two neighbours run through their edge in the same sense
  flat,          ///< no volume
  inside_out,    ///< closed and oriented, but negative volume
};
[[nodiscard]] const char* text(SurfaceFault fault);

/// Result of check_surface.
struct SurfaceCheck {
  SurfaceFault fault = SurfaceFault::none;
  int face = -1;                     ///< where, -1 when it concerns the whole
  int vertex_a = -1, vertex_b = -1;  ///< ends of the edge concerned, -1 when none
  int n_shells = 0;                  ///< connected pieces of the surface (through edges)
  std::vector<int> euler;            ///< V - E + F of each shell; 2 for a topological sphere
};
[[nodiscard]] SurfaceCheck check_surface(const Polyhedron& body);

/// Every vertex lies within `tolerance_m` of the inside of every face's plane.
[[nodiscard]] bool is_convex(const Polyhedron& body, double tolerance_m);

/// The part of a convex body inside `plane` (n . x <= d), closed by a new face with `tag`.
///
/// Vertices within `tolerance_m` of the plane count as on it and stay where they are, so a plane
/// that coincides with a face adds nothing. Empty (no faces) when the body lies outside or on the
/// plane.
[[nodiscard]] Polyhedron clip_convex(const Polyhedron& body, const Plane& plane, int tag,
                                     double tolerance_m);

/// Area of the section of a closed body, convex or not, by a plane [m2].
[[nodiscard]] double section_area(const Polyhedron& body, const Plane& plane);

/// Box between two corners, low < high. Faces: -x, +x, -y, +y, -z, +z, all with `tag`.
[[nodiscard]] Polyhedron box(const Vec3& low, const Vec3& high, int tag = 0);

}  // namespace talus
