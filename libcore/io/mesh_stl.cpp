// io/mesh.hpp for STL, binary and text.
#include <bit>
#include <cstring>

#include "io/mesh_builder.hpp"

namespace talus {
namespace {

constexpr std::size_t header_size = 84, triangle_size = 50;

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t value = 0;
  for (int k = 3; k >= 0; --k) value = value << 8 | static_cast<unsigned char>(bytes[k]);
  return value;
}

Mesh parse_binary(const std::string& bytes, std::size_t n, const std::string& path) {
  MeshBuilder builder;
  for (std::size_t t = 0; t < n; ++t) {
    const Where where{path, 0, "triangle " + std::to_string(t + 1)};
    const char* at = bytes.data() + header_size + t * triangle_size + 12;  // behind the normal
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 p;
      for (Eigen::Index k = 0; k < 3; ++k, at += 4) p[k] = std::bit_cast<float>(little_endian(at));
      builder.add_vertex(p, where);
    }
    const std::int64_t first = builder.n_file_vertices() - 3;
    builder.add_polygon({first, first + 1, first + 2}, where);
  }
  return builder.finished(path);
}

Mesh parse_text(const std::string& bytes, const std::string& path) {
  TextReader reader(bytes, path);
  MeshBuilder builder;
  int n_corners = 0;
  for (std::string_view line; reader.next_line(line);) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    const Where where = reader.where_of_line();
    if (words[0] == "solid") builder.start_group(words.size() > 1 ? std::string(words[1]) : "");
    if (words[0] == "outer") n_corners = 0;
    if (words[0] == "vertex") {
      Vec3 p;
      if (words.size() < 4) throw InputError(where, "a vertex has fewer than three coordinates");
      for (Eigen::Index k = 0; k < 3; ++k)
        if (!parse_double(words[k + 1], p[k]))
          throw InputError(where,
                           "\"" + std::string(words[k + 1].substr(0, 40)) + "\" is not a number");
      builder.add_vertex(p, where);
      ++n_corners;
    }
    if (words[0] == "endloop") {
      if (n_corners != 3)
        throw InputError(where,
                         "a facet has " + std::to_string(n_corners) + " vertices, expected 3");
      const std::int64_t first = builder.n_file_vertices() - 3;
      builder.add_polygon({first, first + 1, first + 2}, where);
      n_corners = 0;
    }
  }
  if (n_corners != 0) throw InputError({path}, "the file ends early");
  return builder.finished(path);
}

}  // namespace

// Text files begin with "solid", but so do some binary ones: the size decides.
Mesh parse_stl(const std::string& bytes, const std::string& path) {
  if (bytes.size() >= header_size) {
    const std::size_t n = little_endian(bytes.data() + 80);
    if (bytes.size() == header_size + n * triangle_size) return parse_binary(bytes, n, path);
  }
  if (bytes.rfind("solid", 0) == 0) return parse_text(bytes, path);
  if (bytes.size() < header_size)
    throw InputError({path}, "is neither a text STL (solid ...) nor a binary one");
  throw InputError(
      {path},
      "is " + std::to_string(bytes.size()) + " bytes, expected " +
          std::to_string(header_size + little_endian(bytes.data() + 80) * triangle_size) +
          " for the " + std::to_string(little_endian(bytes.data() + 80)) +
          " triangles that it announces",
      "the file is cut short or no STL");
}

}  // namespace talus
