// io/mesh.hpp for OFF.

#include "io/mesh_builder.hpp"

namespace talus {

// "OFF", counts, vertices, faces; colours behind the vertices of a face are skipped with the line.
Mesh parse_off(const std::string& bytes, const std::string& path) {
  TextReader reader(bytes, path);
  const std::string_view head = reader.next_word();
  if (head != "OFF" && head != "COFF")
    throw InputError({path, 1}, "the file does not begin with OFF or COFF");
  const std::int64_t n_vertices = reader.next_count(reader.n_left());
  const std::int64_t n_polygons = reader.next_count(reader.n_left());
  static_cast<void>(reader.next_count(std::int64_t{1} << 40));  // edges, often 0
  reader.skip_line();
  MeshBuilder builder;
  for (std::int64_t v = 0; v < n_vertices; ++v) {
    const double x = reader.next_number(), y = reader.next_number(), z = reader.next_number();
    builder.add_vertex({x, y, z}, reader.where());
    if (head == "COFF") reader.skip_line();
  }
  std::vector<std::int64_t> loop;
  for (std::int64_t f = 0; f < n_polygons; ++f) {
    loop.resize(reader.next_count(reader.n_left()));
    for (std::int64_t& v : loop) v = reader.next_count(std::int64_t{1} << 40);
    builder.add_polygon(loop, reader.where());
    reader.skip_line();
  }
  return builder.finished(path);
}

}  // namespace talus
