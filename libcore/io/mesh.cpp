// Reads mesh files of any format and divides them into bodies.
#include "io/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <tuple>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/file_paths.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "geometry/rounding.hpp"

namespace talus {

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
    const int object = mesh.surface.face_tag[f];  // the run of faces under one name
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
  DisjointSets sets(n_faces(surface));
  for (const PolyhedronEdge& edge : edges(surface))
    if (edge.left >= 0 && edge.right >= 0) sets.join(edge.left, edge.right);
  std::map<int, int> group_of_root;
  std::vector<std::vector<int>> groups;
  for (int f = 0; f < n_faces(surface); ++f) {
    const auto [entry, is_new] =
        group_of_root.try_emplace(sets.root(f), static_cast<int>(groups.size()));
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

const MeshGroup& group_of(const Mesh& mesh, int f) { return mesh.groups[mesh.surface.face_tag[f]]; }

// The faces of one part as a surface, whatever else has vertices at the same places.
Polyhedron part_surface(const Mesh& mesh, const std::vector<int>& numbers) {
  Polyhedron part = joined_faces(mesh, numbers, Joining::none);
  if (!is_closed(part)) part = joined_faces(mesh, numbers, Joining::everywhere);
  std::fill(part.face_tag.begin(), part.face_tag.end(), 0);
  return part;
}

// Objects that are given by their parts, by their first faces; the other faces are `left`.
std::map<int, MeshBody> bodies_of_parts(const Mesh& mesh, std::vector<int>& left) {
  std::map<int, std::map<int, std::vector<int>>> faces_of_part;  // by object
  for (int f = 0; f < n_faces(mesh.surface); ++f) {
    const MeshGroup& group = group_of(mesh, f);
    (group.part < 0 ? left : faces_of_part[group.object][group.part]).push_back(f);
  }
  std::map<int, MeshBody> body_of_first_face;
  for (const auto& [object, parts] : faces_of_part) {
    MeshBody body{mesh.object_names[object - 1], {}, {}, object};
    int first_face = n_faces(mesh.surface);
    for (const auto& [part, numbers] : parts) {
      body.parts.push_back(part_surface(mesh, numbers));
      first_face = std::min(first_face, numbers[0]);
    }
    body_of_first_face.emplace(first_face, std::move(body));
  }
  return body_of_first_face;
}

}  // namespace

std::vector<MeshBody> bodies_of(const Mesh& mesh) {
  std::vector<int> left;
  std::map<int, MeshBody> body_of_first_face = bodies_of_parts(mesh, left);
  for (const Joining joining : {Joining::none, Joining::within_objects, Joining::everywhere}) {
    const Polyhedron faces = joined_faces(mesh, left, joining);
    left.clear();
    for (const std::vector<int>& group : connected_faces(faces)) {
      const int first_face = faces.face_tag[group[0]];
      const MeshGroup& named = group_of(mesh, first_face);
      MeshBody body{named.name, surface_of(faces, group), {}, named.object};
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
  const std::string extension = extension_of(path);
  if (extension == ".obj") return bodies_of(parse_obj(content, path));
  if (extension == ".ply") return bodies_of(parse_ply(content, path));
  if (extension == ".off") return bodies_of(parse_off(content, path));
  if (extension == ".stl") return bodies_of(parse_stl(content, path));
  throw InputError(
      {path}, "the format \"" + extension + "\" is not known, expected .obj, .ply, .off or .stl",
      "convert the mesh, or rename the file");
}

namespace {

// "rock" of "rock_part_3"; empty for other names.
std::string object_of_part(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  if (end == std::string::npos || end + 1 == name.size()) return {};
  const std::string head = name.substr(0, end + 1), suffix = part_suffix;
  return head.ends_with(suffix) ? head.substr(0, head.size() - suffix.size()) : std::string{};
}

}  // namespace

namespace {

// Vertices whose rounding matters for the body: map coordinates of a program with few digits.
std::string doubt_on_precision(const std::vector<MeshBody>& bodies) {
  constexpr double least_share = 1e-3;  // of the smallest extent of the body
  int n_rounded = 0;
  double worst = 0;
  std::string words;
  for (const MeshBody& body : bodies) {
    Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
    RoundingFinder rounding;
    const auto look = [&](const Polyhedron& surface) {
      for (const Vec3& v : surface.vertices) {
        low = low.cwiseMin(v), high = high.cwiseMax(v);
        rounding.add(v);
      }
    };
    look(body.surface);
    for (const Polyhedron& part : body.parts) look(part);
    if (!(rounding.step() > least_share * (high - low).minCoeff())) continue;
    ++n_rounded;
    if (rounding.step() > worst) worst = rounding.step(), words = rounding.words();
  }
  if (n_rounded == 0) return {};
  return std::to_string(n_rounded) + (n_rounded == 1 ? " body" : " bodies") +
         " with coordinates of " + words + ", in steps of " + text(worst, 2) +
         " m: shapes and volumes are rounded; shift them to the origin before they "
         "are written, and give position_m";
}

}  // namespace

std::vector<std::string> doubts_about(const std::vector<MeshBody>& bodies) {
  std::map<int, std::vector<std::string>> names_in_object;
  std::vector<std::string> named_like_parts, doubts;
  for (const MeshBody& body : bodies) {
    if (body.object > 0) names_in_object[body.object].push_back(body.name);
    if (body.parts.empty() && !object_of_part(body.name).empty())
      named_like_parts.push_back(body.name);
  }
  if (std::string doubt = doubt_on_precision(bodies); !doubt.empty())
    doubts.push_back(std::move(doubt));
  int n_objects = 0, largest = 0;
  for (const auto& [object, names] : names_in_object) {
    n_objects += names.size() > 1;
    if (names.size() > 1 && (largest == 0 || names.size() > names_in_object[largest].size()))
      largest = object;
  }
  if (n_objects > 0)
    doubts.push_back(
        std::to_string(n_objects) + (n_objects == 1 ? " object holds" : " objects hold") +
        " several closed bodies, which move apart, most of all " + names_in_object[largest][0] +
        ": " + std::to_string(names_in_object[largest].size()) +
        "; convex parts of one body are groups NAME_part_0, NAME_part_1 ... of an "
        "object NAME");
  if (!named_like_parts.empty())
    doubts.push_back(std::to_string(named_like_parts.size()) + " bodies are named like parts, as " +
                     named_like_parts[0] +
                     ", and move apart; parts of one body stand in an object \"o " +
                     object_of_part(named_like_parts[0]) + "\"");
  return doubts;
}

std::string obj_text(const std::vector<Polyhedron>& surfaces, const std::string& name,
                     const Vec3& shift, std::size_t n_before) {
  TALUS_ASSERT(!surfaces.empty() && name.find_first_of(" \t\r\n#") == std::string::npos);
  std::ostringstream out;
  out << "o " << name << '\n';
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    if (surfaces.size() > 1) out << "g " << name << part_suffix << k << '\n';
    for (const Vec3& v : surfaces[k].vertices)
      out << "v " << text(v.x() + shift.x()) << ' ' << text(v.y() + shift.y()) << ' '
          << text(v.z() + shift.z()) << '\n';
    for (int f = 0; f < n_faces(surfaces[k]); ++f) {
      out << 'f';
      for (const int v : face(surfaces[k], f))
        out << ' ' << n_before + static_cast<std::size_t>(v) + 1;
      out << '\n';
    }
    n_before += surfaces[k].vertices.size();
  }
  return out.str();
}

}  // namespace talus
