// Collects vertices and polygons of a mesh file and checks them.
#include "io/mesh_builder.hpp"

#include <utility>

namespace talus {

void MeshBuilder::add_vertex(const Vec3& p, const Where& where) {
  if (!p.allFinite()) throw InputError(where, "a coordinate is not finite");
  mesh_.surface.vertices.push_back(p);
}

void MeshBuilder::add_polygon(const std::vector<std::int64_t>& file_vertices, const Where& where) {
  const auto& points = mesh_.surface.vertices;
  std::vector<int> loop;
  for (const std::int64_t v : file_vertices) {
    if (v < 0 || v >= n_file_vertices())
      throw InputError(where, "a face names vertex " + std::to_string(v + 1) + " of " +
                                  std::to_string(n_file_vertices()));
    if (loop.empty() || points[loop.back()] != points[v]) loop.push_back(static_cast<int>(v));
  }
  while (loop.size() > 1 && points[loop.front()] == points[loop.back()]) loop.pop_back();
  if (loop.size() < 3)
    throw InputError(where, "a face has fewer than three different vertices",
                     "remove degenerate faces with a mesh editor");
  add_face(mesh_.surface, loop, static_cast<int>(mesh_.groups.size()) - 1);
}

void MeshBuilder::start_object(const std::string& name) {
  mesh_.object_names.push_back(name);
  start_group(name);
}

void MeshBuilder::start_group(const std::string& name, int part) {
  mesh_.groups.push_back({name, static_cast<int>(mesh_.object_names.size()), part});
}

Mesh MeshBuilder::finished(const std::string& path) {
  if (n_faces(mesh_.surface) == 0) throw InputError({path}, "holds no face");
  return std::move(mesh_);
}

}  // namespace talus
