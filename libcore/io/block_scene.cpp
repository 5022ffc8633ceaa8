// A scene of blocks and ground at one moment, with names, and the choice of its file format.
#include "io/block_scene.hpp"

#include "io/mesh.hpp"

namespace talus {

std::vector<Polyhedron> connected_surfaces(Polyhedron shell) {
  if (check_surface(shell).n_shells == 1) return {std::move(shell)};
  Mesh mesh;
  mesh.surface = std::move(shell);
  std::vector<Polyhedron> surfaces;
  for (MeshBody& body : bodies_of(mesh)) surfaces.push_back(std::move(body.surface));
  return surfaces;
}

SceneBody ground_body(const Trn& trn, const Vec3& origin) {
  std::vector<int> number(trn.elevation.size(), -1);  // of a node among the vertices
  Polyhedron surface;
  const auto vertex_of = [&](int row, int col) {
    int& at = number[node_index(trn, row, col)];
    if (at < 0) {
      at = static_cast<int>(surface.vertices.size());
      surface.vertices.push_back(node_point(trn, row, col));
    }
    return at;
  };
  for (int t = 0; t < n_triangles(trn); ++t) {
    if (!is_known(trn, t)) continue;
    const auto [r, c] = cell_of_triangle(trn, t);
    const int south_east = vertex_of(r + 1, c + 1), north_west = vertex_of(r, c);
    const std::array<int, 3> corners =
        t % 2 == 0 ? std::array{north_west, vertex_of(r + 1, c), south_east}
                   : std::array{north_west, south_east, vertex_of(r, c + 1)};
    add_face(surface, corners, 0);
  }
  return {{std::move(surface)}, {trn.origin - origin, Quat::Identity()}};
}

std::string block_name(int block) {
  std::string number = std::to_string(block);
  number.insert(0, 6 - std::min<std::size_t>(6, number.size()), '0');
  return "block_" + number;
}

}  // namespace talus
