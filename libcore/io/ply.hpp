// libcore/io/ply.hpp
// Vertices and faces of a PLY file, text or binary, before they are a TIN or bodies.
// in:    any bytes; everything is checked before it is believed
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/types.hpp"

namespace talus {

struct PlyFile {
  std::vector<std::string> comments;          ///< of the header, without the word
  std::vector<Vec3> points;                   ///< finite
  std::vector<std::array<int, 3>> triangles;  ///< where only these will do
  /// Else of face f: corners[face_begin[f]] to corners[face_begin[f + 1] - 1].
  std::vector<int> corners, face_begin{0};
  std::size_t n_header_bytes = 0;
};

/// Properties besides x, y, z of a vertex and vertex_indices of a face are passed over. Throws
/// InputError, with the expectation, for anything else, a truncated or a lying file, and for
/// faces of more or fewer than three corners where only triangles will do.
[[nodiscard]] PlyFile parse_ply_file(std::string_view bytes, const std::string& path,
                                     bool only_triangles);

}  // namespace talus
