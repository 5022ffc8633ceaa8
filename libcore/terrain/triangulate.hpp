// libcore/terrain/triangulate.hpp
// Constrained Delaunay triangulation of points and segments in plan: no triangle crosses a segment.
// in:    cleaned lines (terrain/contours.hpp)
// out:   triangles with their neighbours
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/types.hpp"

namespace talus {

/// Triangles counter-clockwise seen from above. Edge k of a triangle is opposite its corner k.
struct TriangleMesh {
  std::vector<Vec3> points;                   ///< [m]                                (n_points)
  std::vector<std::array<int, 3>> triangles;  ///< indices into `points`              (n_triangles)
  std::vector<std::array<int, 3>> neighbors;  ///< across each edge, -1 outside (n_triangles or 0)
  std::vector<std::uint8_t> constrained;  ///< bit k: edge k is a segment given (n_triangles or 0)
};

/// A triangulation that points can still be added to. Points keep their order and heights.
class Triangulation {
 public:
  /// `segments` index `points` and meet only at ends (clean_lines). Throws InputError naming
  /// `source` when all points are on one line, or segments cross all the same.
  Triangulation(std::vector<Vec3> points, const std::vector<std::array<int, 2>>& segments,
                std::string source);
  ~Triangulation();
  Triangulation(Triangulation&&) noexcept;
  Triangulation& operator=(Triangulation&&) noexcept;

  /// Keeps edges of the triangulation as they are, whatever points are added: pairs of points.
  void fix_edges(const std::vector<std::array<int, 2>>& edges);

  /// Adds points behind the existing ones, in an order that depends on them alone. A point at the
  /// place of another in plan is left out.
  void add(const std::vector<Vec3>& points);

  /// Brings a mesh up to date: the points added since the last mesh go behind its own, which must
  /// be the points given and added before (none at first: a mesh takes the points over, since they
  /// are many), the triangles are as they are now, in an order that depends on nothing but the
  /// input. With `only_triangles` neighbors and constrained stay empty.
  void refresh(TriangleMesh& mesh, bool only_triangles = false);

  /// The first mesh.
  [[nodiscard]] TriangleMesh mesh();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace talus
