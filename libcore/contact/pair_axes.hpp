// libcore/contact/pair_axes.hpp
// The axes that two convex parts may be apart along: normals of their faces, and of pairs of their
// edges whose Gauss arcs cross (theory 2.1, 2.2).
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>

#include "contact/entrance.hpp"
#include "contact/hulls.hpp"

namespace talus {

/// Two parts, and where they are.
struct PartPair {
  const Hulls& hulls;
  const PlacedHulls& placed;
  int a, b;
};

inline int slot(const Hulls& hulls, int part, int vertex) {
  return hulls.vertex_begin[part] + vertex;
}

inline Vec3 edge_direction(const PartPair& parts, int part, const HullEdge& edge) {
  return parts.placed.vertices[slot(parts.hulls, part, edge.b)] -
         parts.placed.vertices[slot(parts.hulls, part, edge.a)];
}

/// Are two edges parallel within a degree, or an angle of another sin^2, or is one of them without
/// length? Of their cross product.
inline bool are_parallel(const Vec3& along_a, const Vec3& along_b, const Vec3& cross,
                         double sin_sq = parallel_sin_sq) {
  return !(cross.squaredNorm() > sin_sq * along_a.squaredNorm() * along_b.squaredNorm());
}

/// The vertex of `part` that lies farthest against `normal`.
inline int farthest_vertex(const Hulls& hulls, const PlacedHulls& placed, int part,
                           const Vec3& normal) {
  int farthest = hulls.vertex_begin[part];
  double lowest = std::numeric_limits<double>::infinity();
  for (int v = farthest; v < hulls.vertex_begin[part + 1]; ++v) {
    const double height = normal.dot(placed.vertices[v]);
    if (height < lowest) farthest = v;
    lowest = std::min(lowest, height);
  }
  return farthest;
}

/// Pairs of edges of two parts, each part taken alone, whose Gauss arcs cross; with `active` those
/// of the bodies' surfaces: the normal from B to A, and the separation along it [m]. For few pairs
/// of parts: no lanes, no list of near edges.
template <class Visit>
void for_each_crossing(const PartPair& parts, bool active, Visit&& visit) {
  const Hulls& hulls = parts.hulls;
  const auto n_edges = [&](int part) {
    return active ? hulls.n_active_edges[part]
                  : hulls.edge_begin[part + 1] - hulls.edge_begin[part];
  };
  const auto normals = [&](int part, const HullEdge& e) {
    const int first = hulls.face_begin[part];
    return std::array{normal_at(parts.placed, first + (active ? e.arc_left : e.left)),
                      normal_at(parts.placed, first + (active ? e.arc_right : e.right))};
  };
  for (int i = 0; i < n_edges(parts.a); ++i) {
    const HullEdge& edge_a = hulls.edges[hulls.edge_begin[parts.a] + i];
    const auto [left_a, right_a] = normals(parts.a, edge_a);
    const Vec3 along_a = edge_direction(parts, parts.a, edge_a);
    const Vec3& from_a = parts.placed.vertices[slot(hulls, parts.a, edge_a.a)];
    for (int k = 0; k < n_edges(parts.b); ++k) {
      const HullEdge& edge_b = hulls.edges[hulls.edge_begin[parts.b] + k];
      const auto [left_b, right_b] = normals(parts.b, edge_b);
      const double a_left = along_a.dot(left_b), a_right = along_a.dot(right_b);
      if (!(a_left * a_right < 0)) continue;
      const Vec3 along_b = edge_direction(parts, parts.b, edge_b);
      const double b_left = along_b.dot(left_a), b_right = along_b.dot(right_a);
      if (!(b_left * b_right < 0) || !(a_left * b_right < 0)) continue;
      Vec3 normal = along_a.cross(along_b);
      if (are_parallel(along_a, along_b, normal)) continue;
      normal *= (a_right > 0 ? 1 : -1) / normal.norm();
      visit(normal, normal.dot(from_a - parts.placed.vertices[slot(hulls, parts.b, edge_b.a)]));
    }
  }
}

/// Faces of both parts by their normal from B to A, and the separation along it.
template <class Visit>
void for_each_face_normal(const PartPair& parts, Visit&& visit) {
  for (const int part : {parts.a, parts.b}) {
    const int begin = parts.hulls.face_begin[part];
    for (int face = begin; face < begin + parts.hulls.n_faces[part]; ++face) {
      const Vec3 outward = normal_at(parts.placed, face);
      const Vec3 normal = part == parts.b ? outward : Vec3(-outward);
      const int other = part == parts.a ? parts.b : parts.a;
      const Vec3& nearest =
          parts.placed.vertices[farthest_vertex(parts.hulls, parts.placed, other, outward)];
      visit(normal, outward.dot(nearest) - parts.placed.offset[face], parts.hulls.cover[face]);
    }
  }
}

}  // namespace talus
