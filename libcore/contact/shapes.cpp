// Surfaces of all blocks for the contact search, in body axes.
#include "contact/shapes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "contact/scales.hpp"

namespace talus {
namespace {

void add_part(Shapes& shapes, const Polyhedron& part, std::span<const int> vertex_of,
              std::span<const Vec3> body_vertices, const Mat3& to_body, int internal_tag) {
  for (int f = 0; f < n_faces(part); ++f) {
    const Vec3 normal = to_body * face_normal(part, f);
    if (part.face_tag[f] == internal_tag) {
      const int corner = vertex_of[face(part, f)[0]];
      shapes.walls.push_back({normal, normal.dot(body_vertices[corner])});
      continue;
    }
    ShapeFace face_data;
    face_data.normal = normal;
    face_data.area = face_area(part, f);
    face_data.vertex_begin = static_cast<int>(shapes.face_vertices.size());
    for (const int v : face(part, f)) shapes.face_vertices.push_back(vertex_of[v]);
    face_data.vertex_end = static_cast<int>(shapes.face_vertices.size());
    for (int i = face_data.vertex_begin; i < face_data.vertex_end; ++i)
      face_data.offset += face_data.normal.dot(body_vertices[shapes.face_vertices[i]]);
    face_data.offset /= face_data.vertex_end - face_data.vertex_begin;
    shapes.faces.push_back(face_data);
  }
  shapes.face_begin.push_back(static_cast<int>(shapes.faces.size()));
  shapes.wall_begin.push_back(static_cast<int>(shapes.walls.size()));
}

void add_edges(Shapes& shapes, const Polyhedron& shell, std::span<const int> vertex_of,
               std::span<const Vec3> body_vertices, const Mat3& to_body) {
  for (const PolyhedronEdge& edge : edges(shell)) {
    if (edge.left < 0 || edge.right < 0) continue;
    const int a = vertex_of[edge.a];
    const int b = vertex_of[edge.b];
    const Vec3 along = (body_vertices[b] - body_vertices[a]).normalized();
    const Vec3 left = to_body * face_normal(shell, edge.left);
    const Vec3 right = to_body * face_normal(shell, edge.right);
    if (left.cross(right).dot(along) > negligible)
      shapes.edges.push_back({a, b, gauss_arc(left, right)});
  }
  shapes.edge_begin.push_back(static_cast<int>(shapes.edges.size()));
}

// Vertices that several polyhedra of a body share are the same point: merge equal coordinates.
std::vector<int> add_vertices(std::vector<Vec3>& body_vertices, const Polyhedron& body,
                              const Vec3& centroid, const Mat3& to_body, double same) {
  std::vector<int> index;
  for (const Vec3& vertex : body.vertices) {
    const Vec3 X = to_body * (vertex - centroid);
    const auto known = std::find_if(body_vertices.begin(), body_vertices.end(),
                                    [&](const Vec3& v) { return (v - X).norm() <= same; });
    index.push_back(static_cast<int>(known - body_vertices.begin()));
    if (known == body_vertices.end()) body_vertices.push_back(X);
  }
  return index;
}

// A face of a body of several parts need not be the farthest of the body along its normal.
double smallest_width(std::span<const ShapeFace> faces, std::span<const Vec3> vertices,
                      double same) {
  double width = std::numeric_limits<double>::infinity();
  for (const ShapeFace& f : faces) {
    double lowest = f.offset, highest = f.offset;
    for (const Vec3& v : vertices) {
      const double along = f.normal.dot(v);
      lowest = std::min(lowest, along);
      if (along > f.offset + same) highest = std::max(highest, along);
    }
    width = std::min(width, highest - lowest);
  }
  return width;
}

}  // namespace

void add_shape(Shapes& shapes, std::span<const Polyhedron> parts, const Polyhedron& shell,
               const Vec3& centroid, const Mat3& to_body, int internal_tag) {
  double size = 0;
  for (const Vec3& v : shell.vertices) size = std::max(size, (v - centroid).norm());
  const double same = 1e-12 * size;
  std::vector<Vec3> vertices;
  const std::vector<int> shell_index = add_vertices(vertices, shell, centroid, to_body, same);
  const std::size_t first_face = shapes.faces.size();
  for (const Polyhedron& part : parts) {
    const std::vector<int> index = add_vertices(vertices, part, centroid, to_body, same);
    add_part(shapes, part, index, vertices, to_body, internal_tag);
  }
  add_edges(shapes, shell, shell_index, vertices, to_body);
  shapes.part_begin.push_back(static_cast<int>(shapes.face_begin.size()) - 1);
  shapes.vertices.insert(shapes.vertices.end(), vertices.begin(), vertices.end());
  shapes.vertex_begin.push_back(static_cast<int>(shapes.vertices.size()));
  shapes.radius.push_back(size);
  shapes.thickness.push_back(
      smallest_width(std::span(shapes.faces).subspan(first_face), vertices, 1e-6 * size));
}

}  // namespace talus
