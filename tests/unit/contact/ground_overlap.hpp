// tests/unit/contact/ground_overlap.hpp
// How deep a convex body is in the ground, without any notion of contacts.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/polyhedron.hpp"
#include "terrain/trn.hpp"

namespace talus::test {

/// The largest vertical overlap, negative: the smallest clearance [m], and where.
struct GroundOverlap {
  double height = -std::numeric_limits<double>::infinity();
  Vec2 at = Vec2::Zero();

  void meet(double overlap, const Vec3& x) {
    if (overlap > height) height = overlap, at = x.head<2>();
  }
};

/// Height of a convex body's lower side at (x, y): the highest of the planes that bound it from
/// below; infinite beside the body.
inline double lower_side(const Polyhedron& body, double x, double y) {
  constexpr double beside = std::numeric_limits<double>::infinity();
  double low = -beside, high = beside;
  for (int f = 0; f < n_faces(body); ++f) {
    const Vec3 n = face_normal(body, f), c = face_centroid(body, f);
    const double outward = n.x() * (x - c.x()) + n.y() * (y - c.y());
    if (std::abs(n.z()) < 1e-9) {
      if (outward > 0) return beside;
      continue;
    }
    const double z = c.z() - outward / n.z();
    if (n.z() < 0)
      low = std::max(low, z);
    else
      high = std::min(high, z);
  }
  return low <= high + 1e-9 ? low : beside;
}

/// Both surfaces are piecewise linear, so the largest overlap is at a vertex of one or where
/// their edges cross in plan. The body lies over known ground.
inline GroundOverlap vertical_overlap(const Trn& trn, const Polyhedron& body) {
  GroundOverlap overlap;
  Vec2 low = body.vertices[0].head<2>(), high = low;
  for (const Vec3& v : body.vertices) {
    low = low.cwiseMin(v.head<2>());
    high = high.cwiseMax(v.head<2>());
    overlap.meet(elevation_at(trn, locate(trn, v.x(), v.y())) - v.z(), v);
  }
  const std::vector<PolyhedronEdge> body_edges = edges(body);
  const GridPoint first = locate(trn, low.x(), high.y()), last = locate(trn, high.x(), low.y());
  for (int row = first.cell.row; row <= std::min(last.cell.row + 1, trn.n_rows - 2); ++row)
    for (int col = first.cell.col; col <= std::min(last.cell.col + 1, trn.n_cols - 2); ++col) {
      const Vec3 node = node_point(trn, row, col);
      overlap.meet(node.z() - lower_side(body, node.x(), node.y()), node);
      for (const EdgeKind kind : {EdgeKind::east, EdgeKind::south, EdgeKind::diagonal}) {
        const TrnEdge edge = trn_edge(trn, row, col, kind);
        const Vec3 f = node_point(trn, edge.b.row, edge.b.col) - node;
        for (const PolyhedronEdge& of_body : body_edges) {
          const Vec3& p = body.vertices[static_cast<std::size_t>(of_body.a)];
          const Vec3 e = body.vertices[static_cast<std::size_t>(of_body.b)] - p, d = node - p;
          const double cross = e.x() * f.y() - e.y() * f.x();
          if (std::abs(cross) < 1e-9) continue;
          const double s = (d.x() * f.y() - d.y() * f.x()) / cross;
          const double t = (d.x() * e.y() - d.y() * e.x()) / cross;
          if (s < 0 || s > 1 || t < 0 || t > 1) continue;
          const Vec3 x = p + s * e;
          if (x.z() < lower_side(body, x.x(), x.y()) + 1e-6)
            overlap.meet((node + t * f).z() - x.z(), x);
        }
      }
    }
  return overlap;
}

}  // namespace talus::test
