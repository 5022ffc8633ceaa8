// libcore/terrain/point_tin.hpp: public
// Scattered points of the ground (surveys, ground returns of a laser scanner) as triangles.
// in:    points relative to a map's origin
// out:   their Delaunay triangles; points that contradict their neighbours
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "terrain/triangulate.hpp"

namespace talus {

/// A point that differs much from its neighbours, or has another height at its own place.
struct PointDoubt {
  Vec3 place = Vec3::Zero();   ///< [m]
  double low = 0, high = 0;    ///< of its neighbours, or of the other points at its place [m]
  bool is_impossible = false;  ///< two heights in one place, or farther off than ground can be
};

struct PointMesh {
  TriangleMesh mesh;
  std::size_t n_read = 0;
  std::size_t n_repeated = 0;    ///< points on another one: one of them is kept, at the mean height
  double repeated_differ_m = 0;  ///< largest difference of their heights
  std::vector<PointDoubt> doubts;
};

/// A point is in doubt when it is above all its neighbours, or below them all, by more than 70
/// degrees along every edge; it is impossible when four in five of its edges are higher than 200 m
/// and five times their length. Points in one place (x, y) that differ by more than 0.5 m in height
/// are impossible; laser scans rounded to centimetres differ by less. Of two points up to 0.5 m and
/// a fifth of the median edge apart that differ by more, and by more than 79 degrees, the upper one
/// is in doubt. Uses the points up. Throws InputError naming `source` when all are on one line.
[[nodiscard]] PointMesh mesh_of_points(std::vector<Vec3> points, const std::string& source);

/// Of the triangles' edges in plan [m].
struct EdgeLengths {
  double median = 0, longest = 0;
};
[[nodiscard]] EdgeLengths edge_lengths(const TriangleMesh& mesh);

}  // namespace talus
