#include "io/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/mesh_builder.hpp"

namespace talus {

void MeshBuilder::add_vertex(const Vec3& p, const Where& where) {
  if (!p.allFinite()) throw InputError(where, "a coordinate is not finite");
  const auto [entry, is_new] = known_.try_emplace(std::array{p.x() + 0.0, p.y() + 0.0, p.z() + 0.0},
                                                  static_cast<int>(mesh_.surface.vertices.size()));
  if (is_new) mesh_.surface.vertices.push_back(p);
  index_.push_back(entry->second);
}

void MeshBuilder::add_polygon(const std::vector<std::int64_t>& file_vertices, const Where& where) {
  std::vector<int> loop;
  for (const std::int64_t v : file_vertices) {
    if (v < 0 || v >= static_cast<std::int64_t>(index_.size()))
      throw InputError(where, "a face names vertex " + std::to_string(v + 1) + " of " +
                                  std::to_string(index_.size()));
    const int welded = index_[static_cast<std::size_t>(v)];
    if (loop.empty() || loop.back() != welded) loop.push_back(welded);
  }
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  if (loop.size() < 3)
    throw InputError(where, "a face has fewer than three different vertices",
                     "remove degenerate faces with a mesh editor");
  add_face(mesh_.surface, loop, static_cast<int>(mesh_.names.size()) - 1);
}

void MeshBuilder::start_object(const std::string& name) { mesh_.names.push_back(name); }

Mesh MeshBuilder::finished(const std::string& path) {
  if (n_faces(mesh_.surface) == 0) throw InputError({path}, "holds no face");
  return std::move(mesh_);
}

std::vector<MeshBody> bodies_of(const Mesh& mesh) {
  const Polyhedron& all = mesh.surface;
  std::vector<int> parent(all.vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (int f = 0; f < n_faces(all); ++f)
    for (const int v : face(all, f)) parent[root(v)] = root(face(all, f)[0]);
  std::vector<MeshBody> bodies;
  std::map<int, int> body_of_root;
  std::vector<int> local(all.vertices.size(), -1), loop;
  for (int f = 0; f < n_faces(all); ++f) {
    const auto [entry, is_new] =
        body_of_root.try_emplace(root(face(all, f)[0]), static_cast<int>(bodies.size()));
    if (is_new) bodies.push_back({mesh.names[all.face_tag[f]], {}});
    Polyhedron& surface = bodies[entry->second].surface;
    loop.clear();
    for (const int v : face(all, f)) {
      if (local[v] < 0) {
        local[v] = static_cast<int>(surface.vertices.size());
        surface.vertices.push_back(all.vertices[v]);
      }
      loop.push_back(local[v]);
    }
    add_face(surface, loop, 0);
  }
  return bodies;
}

std::vector<MeshBody> read_mesh(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  if (file) content << file.rdbuf();
  if (!file || content.str().empty())
    throw InputError({path}, "cannot be read, or is empty", "give an OBJ, PLY, OFF or STL file");
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (extension == ".obj") return bodies_of(parse_obj(content.str(), path));
  if (extension == ".ply") return bodies_of(parse_ply(content.str(), path));
  if (extension == ".off") return bodies_of(parse_off(content.str(), path));
  if (extension == ".stl") return bodies_of(parse_stl(content.str(), path));
  throw InputError(
      {path}, "the format \"" + extension + "\" is not known, expected .obj, .ply, .off or .stl",
      "convert the mesh, or rename the file");
}

std::string obj_text(const Polyhedron& body, const std::string& name, const Vec3& shift) {
  std::ostringstream out;
  out << "o " << name << '\n';
  for (const Vec3& v : body.vertices)
    out << "v " << text(v.x() + shift.x()) << ' ' << text(v.y() + shift.y()) << ' '
        << text(v.z() + shift.z()) << '\n';
  for (int f = 0; f < n_faces(body); ++f) {
    out << 'f';
    for (const int v : face(body, f)) out << ' ' << v + 1;
    out << '\n';
  }
  return out.str();
}

}  // namespace talus
