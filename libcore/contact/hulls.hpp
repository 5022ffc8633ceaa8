// libcore/contact/hulls.hpp: public
// The convex parts of all blocks as the search of contacts between blocks reads them.
// in:    the parts of each body (block set), then the pose of each body at every step
// out:   vertices in local axes, and face normals as padded arrays of x, y and z
// theory: docs/theory/theory.md 2.2 (edges and their Gauss arcs), 2.6
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hpp"
#include "base/workers.hpp"
#include "contact/neighbours.hpp"
#include "geometry/polyhedron.hpp"
#include "motion/pose.hpp"

namespace talus {

/// How much of a face lies against other parts of its body.
enum class FaceCover : std::uint8_t { none, part, all };

/// An edge of a convex part. Faces, normals and vertices count from the part's first.
struct HullEdge {
  int a = 0, b = 0;                 ///< vertices, a -> b as face `left` runs through it
  int left = 0, right = 0;          ///< faces of the part
  int arc_left = 0, arc_right = 0;  ///< normals of the body's surface at the edge: its Gauss arc
};

/// Convex parts at rest, in body axes (origin at the body's centroid), ordered by body.
struct Hulls {  // clang-format off
  // bodies
  std::vector<int> part_begin{0};     ///< parts of body b: [b], [b + 1)                 (n_bodies + 1)
  std::vector<double> radius;         ///< farthest vertex from the centroid [m]         (n_bodies)
  std::vector<int> body_vertex_begin{0};  ///< vertices of body b                        (n_bodies + 1)
  std::vector<int> body_edge_begin{0};    ///< edges of body b                           (n_bodies + 1)
  // parts
  std::vector<int> body;              ///< body of part p                                (n_parts)
  std::vector<double> thickness;      ///< smallest width over the face normals [m]      (n_parts)
  std::vector<int> vertex_begin{0};   ///< vertices of part p: [p], [p + 1)              (n_parts + 1)
  std::vector<int> face_begin{0};     ///< face slots of part p, a multiple of 4         (n_parts + 1)
  std::vector<int> n_faces;           ///< own faces; after them those of other parts that an arc needs (n_parts)
  std::vector<int> edge_begin{0};     ///< edges of part p                               (n_parts + 1)
  std::vector<int> n_active_edges;    ///< convex edges of the body's surface; they come first (n_parts)
  // vertices
  std::vector<Vec3> vertices;         ///< body axes [m]                                 (n_vertices)
  std::vector<int> ring_begin{0};     ///< faces at vertex v: ring_faces[[v], [v + 1))   (n_vertices + 1)
  std::vector<int> ring_faces;        ///< own faces of the part
  // face slots; the padding repeats the part's last normal
  std::vector<double> nx, ny, nz;     ///< unit outward normals, body axes               (n_face_slots)
  std::vector<int> loop_begin{0};     ///< corners of face f: loop_*[[f], [f + 1))       (n_face_slots + 1)
  std::vector<int> loop_vertices;     ///< corners, counter-clockwise from outside
  std::vector<int> loop_edges;        ///< edge from corner k to the next
  std::vector<int> joint_set;         ///< FaceOrigin or joint set                       (n_face_slots)
  std::vector<FaceCover> cover;       ///< by other parts of the body                    (n_face_slots)
  // edges
  std::vector<HullEdge> edges;        ///<                                               (n_edges)
};  // clang-format on

[[nodiscard]] inline int n_bodies(const Hulls& hulls) {
  return static_cast<int>(hulls.radius.size());
}
[[nodiscard]] inline int n_parts(const Hulls& hulls) { return static_cast<int>(hulls.body.size()); }

/// Adds a body given by its convex parts in local coordinates; `to_body` rotates local into body
/// axes. face_tag is kept as the joint set.
///
/// Faces that other parts of the body cover are internal: they stop nothing. So are those tagged
/// face_internal of a body that `stands_among_others` for good, as a block of a fixed slope does.
/// Edges where the body's surface is flat or concave are inactive: they make no edge-edge contact
/// (theory 2.2). Throws InputError (without a place) when a part is not closed and convex within
/// 1e-6 of its size.
void add_hulls(Hulls& hulls, std::span<const Polyhedron> parts, const Vec3& centroid,
               const Mat3& to_body, bool stands_among_others = false);

/// Hulls of all blocks of a block set, in their order; `rest[b]` is the pose as cut.
struct BlockSet;
[[nodiscard]] Hulls make_hulls(const BlockSet& set, std::span<const Pose> rest);

/// Hulls where the bodies are now, in local axes; numbered as in Hulls.
struct PlacedHulls {  // clang-format off
  // place_hulls
  std::vector<Vec3> vertices;         ///< [m]                                           (n_vertices)
  std::vector<double> nx, ny, nz;     ///< unit outward normals                          (n_face_slots)
  std::vector<double> offset;         ///< normal . x of the face's plane [m]            (n_face_slots)
  std::vector<Vec3> position;         ///< centroids [m]                                 (n_bodies)
  std::vector<Mat3> axes;             ///< body to local axes, times the stretch         (n_bodies)
  /// Bound on the path that turning has moved any vertex about the centroid, summed since the first
  /// placement; the difference of two values bounds the motion between them [m]          (n_bodies)
  std::vector<double> turned;
};  // clang-format on

/// Brings `placed` to the given poses; body b is skipped where `moving[b]` is 0 (an empty span
/// moves all). `stretch` is I + strain in body axes; empty for rigid bodies. The first time all
/// bodies have to have a pose; later on those behind the last pose stay where they are. `workers`
/// share the bodies, or none.
void place_hulls(const Hulls& hulls, std::span<const Pose> poses, std::span<const Mat3> stretch,
                 std::span<const std::uint8_t> moving, PlacedHulls& placed,
                 Workers* workers = nullptr);

/// Brings one rigid body of `placed` to a pose.
void place_body(const Hulls& hulls, int b, const Pose& pose, PlacedHulls& placed);

/// The smallest box with sides along the local axes around a part.
[[nodiscard]] Box box_of_part(const Hulls& hulls, const PlacedHulls& placed, int part);

[[nodiscard]] inline Vec3 normal_at(const PlacedHulls& placed, int slot) {
  return {placed.nx[slot], placed.ny[slot], placed.nz[slot]};
}

}  // namespace talus
