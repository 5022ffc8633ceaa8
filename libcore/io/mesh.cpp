#include "io/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <sstream>
#include <tuple>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "io/mesh_builder.hpp"

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
  add_face(mesh_.surface, loop, static_cast<int>(mesh_.names.size()) - 1);
}

void MeshBuilder::start_object(const std::string& name) { mesh_.names.push_back(name); }

Mesh MeshBuilder::finished(const std::string& path) {
  if (n_faces(mesh_.surface) == 0) throw InputError({path}, "holds no face");
  return std::move(mesh_);
}

namespace {

// Which vertices of a file count as one.
enum class Joining { none, within_objects, everywhere };

// Some faces of a mesh, vertices joined; face_tag is the number of the face in the mesh.
Polyhedron joined_faces(const Mesh& mesh, const std::vector<int>& numbers, Joining joining) {
  Polyhedron faces;
  std::map<std::tuple<int, double, double, double>, int> known;
  std::vector<int> loop;
  for (const int f : numbers) {
    loop.clear();
    const int object = mesh.surface.face_tag[f];
    for (const int v : face(mesh.surface, f)) {
      const Vec3& p = mesh.surface.vertices[v];
      const int scope = joining == Joining::none             ? v
                        : joining == Joining::within_objects ? object
                                                             : 0;
      const auto [entry, is_new] =  // adding 0 makes -0 and 0 equal keys
          known.try_emplace({scope, p.x() + 0.0, p.y() + 0.0, p.z() + 0.0},
                            static_cast<int>(faces.vertices.size()));
      if (is_new) faces.vertices.push_back(p);
      loop.push_back(entry->second);
    }
    add_face(faces, loop, f);
  }
  return faces;
}

// Groups of faces that hang together through edges, in the order of their first faces.
std::vector<std::vector<int>> connected_faces(const Polyhedron& surface) {
  std::vector<int> parent(n_faces(surface));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  for (const PolyhedronEdge& edge : edges(surface))
    if (edge.left >= 0 && edge.right >= 0) parent[root(edge.left)] = root(edge.right);
  std::map<int, int> group_of_root;
  std::vector<std::vector<int>> groups;
  for (int f = 0; f < n_faces(surface); ++f) {
    const auto [entry, is_new] =
        group_of_root.try_emplace(root(f), static_cast<int>(groups.size()));
    if (is_new) groups.emplace_back();
    groups[entry->second].push_back(f);
  }
  return groups;
}

Polyhedron surface_of(const Polyhedron& all, const std::vector<int>& group) {
  Polyhedron surface;
  std::map<int, int> local;
  std::vector<int> loop;
  for (const int f : group) {
    loop.clear();
    for (const int v : face(all, f)) {
      const auto [entry, is_new] = local.try_emplace(v, static_cast<int>(surface.vertices.size()));
      if (is_new) surface.vertices.push_back(all.vertices[v]);
      loop.push_back(entry->second);
    }
    add_face(surface, loop, 0);
  }
  return surface;
}

bool is_closed(const Polyhedron& surface) {
  const SurfaceFault fault = check_surface(surface).fault;
  return fault == SurfaceFault::none || fault == SurfaceFault::inside_out;
}

}  // namespace

std::vector<MeshBody> bodies_of(const Mesh& mesh) {
  std::map<int, MeshBody> body_of_first_face;
  std::vector<int> left(n_faces(mesh.surface));
  std::iota(left.begin(), left.end(), 0);
  for (const Joining joining : {Joining::none, Joining::within_objects, Joining::everywhere}) {
    const Polyhedron faces = joined_faces(mesh, left, joining);
    left.clear();
    for (const std::vector<int>& group : connected_faces(faces)) {
      const int first_face = faces.face_tag[group[0]];
      MeshBody body{mesh.names[mesh.surface.face_tag[first_face]], surface_of(faces, group)};
      if (joining == Joining::everywhere || is_closed(body.surface))
        body_of_first_face.emplace(first_face, std::move(body));
      else
        for (const int f : group) left.push_back(faces.face_tag[f]);
    }
    std::sort(left.begin(), left.end());
  }
  std::vector<MeshBody> bodies;
  for (auto& [first_face, body] : body_of_first_face) bodies.push_back(std::move(body));
  return bodies;
}

std::vector<MeshBody> read_mesh(const std::string& path) {
  const std::string content = read_file(path, "give an OBJ, PLY, OFF or STL file");
  if (content.empty()) throw InputError({path}, "is empty", "give an OBJ, PLY, OFF or STL file");
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (extension == ".obj") return bodies_of(parse_obj(content, path));
  if (extension == ".ply") return bodies_of(parse_ply(content, path));
  if (extension == ".off") return bodies_of(parse_off(content, path));
  if (extension == ".stl") return bodies_of(parse_stl(content, path));
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
