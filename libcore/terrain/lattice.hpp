// libcore/terrain/lattice.hpp
// Square lattice laid over a triangle mesh: the triangle of each node, its distance from the lines,
// and values spread from the nodes that have one to those that have none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "terrain/triangulate.hpp"

namespace talus {

/// Node (i, j) is at low + spacing * (i, j) and has the number j * n_x + i.
struct Lattice {
  Vec2 low = Vec2::Zero();    ///< place of node (0, 0) [m]
  double spacing = 1;         ///< [m]
  int n_x = 0, n_y = 0;       ///< nodes
  std::vector<int> triangle;  ///< the mesh's triangle under each node, -1 none   (n_x * n_y)

  [[nodiscard]] std::size_t size() const { return triangle.size(); }
  [[nodiscard]] Vec2 place(std::size_t node) const {
    const auto n = static_cast<std::size_t>(n_x);
    return low + spacing * Vec2(static_cast<double>(node % n), static_cast<double>(node / n));
  }
};

/// Lays a lattice over the whole mesh; `triangle` is filled by scan conversion, without gaps.
[[nodiscard]] Lattice lay_lattice(const TriangleMesh& mesh, double spacing);

/// Height of the mesh's triangle `t` at `place` [m].
[[nodiscard]] double height_in_triangle(const TriangleMesh& mesh, int t, const Vec2& place);

/// Points that divide the constrained edges longer than `spacing` into equal parts no longer [m].
[[nodiscard]] std::vector<Vec3> points_between(const TriangleMesh& mesh, double spacing);

/// Distance of each node from the nearest of `points` and `more` [m], exact to 8 % (chamfer
/// distance).
[[nodiscard]] std::vector<float> distance_to_points(const Lattice& lattice,
                                                    const std::vector<Vec3>& points,
                                                    const std::vector<Vec3>& more);

/// Gives every node where known[node] == 0 a smooth mean of the known values around it, by
/// averaging to ever coarser lattices and interpolating back. All zero when nothing is known.
void spread_values(int n_x, int n_y, std::vector<float>& values, std::vector<std::uint8_t> known);

}  // namespace talus
