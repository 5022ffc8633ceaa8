// libcore/io/mesh.hpp
// Bodies from mesh files: OBJ, PLY (text and binary), OFF, STL (text and binary); one or many a
// file.
// in:    any bytes; everything is checked before it is believed
// out:   one surface for each body of the file, as it stands there
#pragma once

#include <string>
#include <vector>

#include "geometry/polyhedron.hpp"

namespace talus {

/// A connected surface of a file, not yet checked for being a solid.
struct MeshBody {
  std::string name;    ///< object or group of an OBJ file; else empty
  Polyhedron surface;  ///< coordinates of the file; face_tag is 0
};

/// Vertices and polygons of a file before they are taken apart into bodies.
struct Mesh {
  Polyhedron surface;  ///< face_tag: index into `names`
  std::vector<std::string> names{""};
};

/// Parsers of the formats; `path` is what messages say. They throw InputError with file and line
/// (or what was being read) for anything that is not the format, names a vertex that does not
/// exist, is not finite, or ends early. Faces with fewer than three different vertices are refused
/// too.
[[nodiscard]] Mesh parse_obj(const std::string& bytes, const std::string& path);
[[nodiscard]] Mesh parse_ply(const std::string& bytes, const std::string& path);
[[nodiscard]] Mesh parse_off(const std::string& bytes, const std::string& path);
[[nodiscard]] Mesh parse_stl(const std::string& bytes, const std::string& path);

/// The bodies of a mesh, in the order of their first faces: faces that hang together through edges.
///
/// Closed bodies of the file's own vertices stand as they are, so that bodies which touch, in
/// faces, edges or vertices at equal coordinates, stay apart. What is open so has its vertices at
/// equal coordinates joined, within an object of the file first and then over the whole file: many
/// formats and programs repeat them for each face. Of bodies that touch along a whole edge then,
/// each keeps the faces about its own material.
[[nodiscard]] std::vector<MeshBody> bodies_of(const Mesh& mesh);

/// Reads a file; the format follows from the extension. Throws InputError.
[[nodiscard]] std::vector<MeshBody> read_mesh(const std::string& path);

/// A body as the text of an OBJ file, coordinates with 17 digits, faces by `face_tag`.
[[nodiscard]] std::string obj_text(const Polyhedron& body, const std::string& name,
                                   const Vec3& shift);

}  // namespace talus
