#include <cmath>
#include <map>
#include <string>

#include "io/mesh_builder.hpp"

namespace talus {
namespace {

// "7", "7/1", "7//3", "-2": the vertex, counted from 0; -1 counts back from the last one read.
std::int64_t vertex_of(std::string_view word, std::int64_t n_vertices, const Where& where) {
  double number = 0;
  const std::string_view head = word.substr(0, word.find('/'));
  if (!parse_double(head, number) || number != std::floor(number) || number == 0 ||
      std::abs(number) > 4e15)
    throw InputError(where, "\"" + std::string(word.substr(0, 40)) + "\" is not a vertex number");
  const auto index = static_cast<std::int64_t>(number);
  return index > 0 ? index - 1 : n_vertices + index;
}

Vec3 point_of(const std::vector<std::string_view>& words, const Where& where) {
  Vec3 p;
  if (words.size() < 4) throw InputError(where, "a vertex has fewer than three coordinates");
  for (Eigen::Index k = 0; k < 3; ++k)
    if (!parse_double(words[static_cast<std::size_t>(k) + 1], p[k]))
      throw InputError(where,
                       "\"" + std::string(words[static_cast<std::size_t>(k) + 1].substr(0, 40)) +
                           "\" is not a number");
  return p;
}

}  // namespace

Mesh parse_obj(const std::string& bytes, const std::string& path) {
  MeshBuilder builder;
  TextReader reader(bytes, path);
  std::map<std::string, int> objects;  // line of each
  for (std::string_view line; reader.next_line(line);) {
    const auto words = words_of(line.substr(0, line.find('#')));
    if (words.empty()) continue;
    const Where where = reader.where_of_line();
    if (words[0] == "v") {
      builder.add_vertex(point_of(words, where), where);
    } else if (words[0] == "f") {
      std::vector<std::int64_t> loop;
      for (std::size_t k = 1; k < words.size(); ++k)
        loop.push_back(vertex_of(words[k], builder.n_file_vertices(), where));
      builder.add_polygon(loop, where);
    } else if (words[0] == "o" || words[0] == "g") {
      const std::string name = words.size() > 1 ? std::string(words[1]) : "";
      if (words[0] == "o" && !name.empty() && !objects.emplace(name, where.line).second)
        throw InputError(where,
                         "object " + name + " stands here a second time, first in line " +
                             std::to_string(objects[name]),
                         "give each block a name of its own, or remove the copy");
      builder.start_object(name);
    }
  }
  return builder.finished(path);
}

}  // namespace talus
