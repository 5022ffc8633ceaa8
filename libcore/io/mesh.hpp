// libcore/io/mesh.hpp: public
// Bodies from mesh files: OBJ, PLY (text and binary), OFF, STL (text and binary); one or many a
// file.
// in:    any bytes; everything is checked before it is believed
// out:   one surface for each body of the file, unchanged
#pragma once

#include <string>
#include <vector>

#include "geometry/polyhedron.hpp"

namespace talus {

/// Between the name of an OBJ object and the number of its part: "rock_part_3".
inline constexpr const char* part_suffix = "_part_";

/// A connected surface of a file, or the parts of one body; not yet checked for being a solid.
struct MeshBody {
  std::string name;  ///< object or group of an OBJ file; else empty
  Polyhedron
      surface;  ///< coordinates of the file; face_tag is 0; without faces when parts are given
  std::vector<Polyhedron> parts{};  ///< those that an OBJ file names, in their order; else empty
  int object = 0;                   ///< the `o` of the file that it is in, from 1; 0: none
};

/// A run of faces under one name: of an `o` or `g` of an OBJ file, or of a solid of an STL file.
struct MeshGroup {
  std::string name{};
  int object = 0;  ///< the `o` that it is in, from 1; 0: none
  int part = -1;   ///< k where it is group NAME_part_k of object NAME; else -1
};

/// Vertices and polygons of a file before they are taken apart into bodies.
struct Mesh {
  Polyhedron surface;                       ///< face_tag: index into `groups`
  std::vector<MeshGroup> groups{{}};        ///< in the order of the file
  std::vector<std::string> object_names{};  ///< of object 1, 2 ...
};

/// Parsers of the formats; `path` is its name in messages. They throw InputError with file and line
/// (or the element that was being read) for anything that is not the format, names a vertex that
/// does not exist, is not finite, or ends early. Faces with fewer than three different vertices are
/// refused too; so is an OBJ object that has parts (groups NAME_part_0, NAME_part_1 ... of object
/// NAME) and faces outside of them, leaves a number out, or has its parts in another object.
[[nodiscard]] Mesh parse_obj(const std::string& bytes, const std::string& path);
[[nodiscard]] Mesh parse_ply(const std::string& bytes, const std::string& path);
[[nodiscard]] Mesh parse_off(const std::string& bytes, const std::string& path);
[[nodiscard]] Mesh parse_stl(const std::string& bytes, const std::string& path);

/// The bodies of a mesh, in the order of their first faces: an object with parts, otherwise faces
/// that hang together through edges.
///
/// Closed bodies of the file's own vertices stay as they are, so that bodies which touch, in faces,
/// edges or vertices at equal coordinates, stay apart. Surfaces that are open so have vertices at
/// equal coordinates joined, within an object of the file first and then over the whole file: many
/// formats and programs repeat them for each face. Of bodies that touch along a whole edge then,
/// each keeps the faces about its own material. Of parts, each is closed by its own vertices, or
/// joined.
[[nodiscard]] std::vector<MeshBody> bodies_of(const Mesh& mesh);

/// Reads a file; the format follows from the extension. Throws InputError.
[[nodiscard]] std::vector<MeshBody> read_mesh(const std::string& path);

/// Likely mistakes in the bodies of a file, a line each: several bodies in one object move apart,
/// and so do bodies that are named like parts where the object of that name is missing.
[[nodiscard]] std::vector<std::string> doubts_about(const std::vector<MeshBody>& bodies);

/// A body as the text of an OBJ file, coordinates with 17 digits: an object of one surface, or of
/// several that are its convex parts, each a group NAME_part_k. The name has no blanks. `n_before`:
/// vertices of the file before these.
[[nodiscard]] std::string obj_text(const std::vector<Polyhedron>& surfaces, const std::string& name,
                                   const Vec3& shift, std::size_t n_before = 0);

}  // namespace talus
