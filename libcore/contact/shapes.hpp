// libcore/contact/shapes.hpp: public
// The surfaces of all blocks as the contact search reads them, in body axes: origin at the
// centroid, axes along the principal axes of inertia. Flat arrays, ordered by block.
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "contact/entrance.hpp"
#include "geometry/polyhedron.hpp"

namespace talus {

/// A convex edge of a block's shell.
struct ShapeEdge {
  int a = 0, b = 0;  ///< vertices, counted from the block's first
  GaussArc arc;      ///< in body axes
};

/// A face of a convex part.
struct ShapeFace {
  Vec3 normal;                           ///< unit outward, body axes
  double offset = 0;                     ///< normal . X of the face's plane [m]
  double area = 0;                       ///< [m2]
  int vertex_begin = 0, vertex_end = 0;  ///< its corners in Shapes::face_vertices
};

/// Plane of a face between two parts of a body, seen from the part.
struct ShapeWall {
  Vec3 normal;        ///< unit outward, body axes
  double offset = 0;  ///< normal . X of the plane [m]
};

struct Shapes {  // clang-format off
  std::vector<int> vertex_begin{0};  ///< vertices of block b: [b], [b + 1)             (n_blocks + 1)
  std::vector<Vec3> vertices;        ///< body axes [m]                                 (n_vertices)
  std::vector<int> part_begin{0};    ///< convex parts of block b                       (n_blocks + 1)
  std::vector<int> face_begin{0};    ///< faces of part p                               (n_parts + 1)
  std::vector<ShapeFace> faces;      ///< those between two parts of a body left out    (n_faces)
  std::vector<int> wall_begin{0};    ///< walls of part p                               (n_parts + 1)
  std::vector<ShapeWall> walls;      ///< the faces left out                            (n_walls)
  std::vector<int> face_vertices;    ///< counted from the block's first vertex
  std::vector<int> edge_begin{0};    ///< convex edges of block b                       (n_blocks + 1)
  std::vector<ShapeEdge> edges;      ///< flat and concave ones cannot touch            (n_edges)
  std::vector<double> radius;        ///< farthest vertex from the centroid [m]         (n_blocks)
  std::vector<double> thickness;     ///< smallest width over the face normals [m]      (n_blocks)
};  // clang-format on

/// Vertices of block b.
[[nodiscard]] inline std::span<const Vec3> vertices_of(const Shapes& shapes, int b) {
  const auto begin = static_cast<std::size_t>(shapes.vertex_begin[b]);
  return {shapes.vertices.data() + begin,
          static_cast<std::size_t>(shapes.vertex_begin[b + 1]) - begin};
}

[[nodiscard]] inline std::span<const ShapeEdge> edges_of(const Shapes& shapes, int b) {
  const auto begin = static_cast<std::size_t>(shapes.edge_begin[b]);
  return {shapes.edges.data() + begin, static_cast<std::size_t>(shapes.edge_begin[b + 1]) - begin};
}

/// Adds a body given by its convex parts (faces tagged `internal_tag` lie between parts) and the
/// closed shell of their union, all in local coordinates; `to_body` rotates local into body axes.
///
/// A shell edge is kept when the angle of its faces opens outwards by more than 1e-6 rad.
void add_shape(Shapes& shapes, std::span<const Polyhedron> parts, const Polyhedron& shell,
               const Vec3& centroid, const Mat3& to_body, int internal_tag);

}  // namespace talus
