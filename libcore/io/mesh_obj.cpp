// io/mesh.hpp for Wavefront OBJ.
#include <cmath>
#include <map>
#include <set>
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
    if (!parse_double(words[k + 1], p[k]))
      throw InputError(where,
                       "\"" + std::string(words[k + 1].substr(0, 40)) + "\" is not a number");
  return p;
}

constexpr const char* how_to_name =
    "groups NAME_part_0, NAME_part_1 ... of object NAME are all of its convex parts";

// k of group "NAME_part_k"; -1 for other names, also with zeros in front.
int part_number(std::string_view group, const std::string& object) {
  const std::string head = object + part_suffix;
  if (object.empty() || !group.starts_with(head)) return -1;
  const std::string_view digits = group.substr(head.size());
  if (digits.empty() || digits.size() > 6 || (digits[0] == '0' && digits.size() > 1) ||
      digits.find_first_not_of("0123456789") != std::string_view::npos)
    return -1;
  int number = 0;
  for (const char digit : digits) number = 10 * number + (digit - '0');
  return number;
}

// Takes an OBJ file line by line, keeping where objects and groups begin.
class ObjParser {
 public:
  explicit ObjParser(const std::string& path) : path_(path) {}

  void take(const std::vector<std::string_view>& words, const Where& where) {
    if (words[0] == "v") {
      builder_.add_vertex(point_of(words, where), where);
    } else if (words[0] == "f") {
      std::vector<std::int64_t> loop;
      for (std::size_t k = 1; k < words.size(); ++k)
        loop.push_back(vertex_of(words[k], builder_.n_file_vertices(), where));
      builder_.add_polygon(loop, where);
    } else if (words[0] == "o") {
      begin_object(words.size() > 1 ? std::string(words[1]) : "", where);
    } else if (words[0] == "g") {
      begin_group(words, where);
    }
  }

  Mesh finished() {
    const Mesh mesh = builder_.finished(path_);
    check_places(mesh);
    check_parts(mesh);
    return mesh;
  }

 private:
  void begin_object(const std::string& name, const Where& where) {
    const auto [known, is_new] = line_of_object_.emplace(name, where.line);
    if (!name.empty() && !is_new)
      throw InputError(where,
                       "object " + name + " is defined again here, first in line " +
                           std::to_string(known->second),
                       "give each block a name of its own, or remove the copy");
    object_ = name;
    builder_.start_object(name);
    line_of_group_.push_back(where.line);
  }

  // A group may have several names; one of them at most is that of a part.
  void begin_group(const std::vector<std::string_view>& words, const Where& where) {
    std::string name = words.size() > 1 ? std::string(words[1]) : "";
    int part = -1;
    for (std::size_t k = 1; k < words.size(); ++k) {
      const int number = part_number(words[k], object_);
      if (number < 0 || number == part) continue;
      if (part >= 0)
        throw InputError(where, "faces are said to belong to two parts of object " + object_,
                         how_to_name);
      part = number, name = std::string(words[k]);
    }
    builder_.start_group(name, part);
    line_of_group_.push_back(where.line);
  }

  // A part inside another object than its own would be a separate body.
  void check_places(const Mesh& mesh) const {
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
      const MeshGroup& group = mesh.groups[g];
      const std::size_t end = group.part < 0 ? group.name.rfind(part_suffix) : std::string::npos;
      if (end == std::string::npos) continue;
      const std::string own = group.name.substr(0, end);
      const auto known = line_of_object_.find(own);
      if (own.empty() || known == line_of_object_.end() || part_number(group.name, own) < 0)
        continue;
      throw InputError({path_, line_of_group_[g]},
                       "group " + group.name + " is outside of object " + own +
                           ", which begins in line " + std::to_string(known->second),
                       how_to_name);
    }
  }

  // An object that has parts has all its faces in them, and leaves no number out.
  void check_parts(const Mesh& mesh) const {
    const std::size_t n_objects = mesh.object_names.size();
    std::vector<std::set<int>> named(n_objects + 1), filled(n_objects + 1);
    std::vector<int> line_of_part(n_objects + 1, 0);
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
      const MeshGroup& group = mesh.groups[g];
      if (group.part < 0) continue;
      named[group.object].insert(group.part);
      if (line_of_part[group.object] == 0) line_of_part[group.object] = line_of_group_[g];
    }
    for (const int g : mesh.surface.face_tag) {
      const MeshGroup& group = mesh.groups[g];
      if (named[group.object].empty()) continue;
      const std::string& object = mesh.object_names[group.object - 1];
      if (group.part < 0)
        throw InputError({path_, line_of_group_[g]},
                         "faces of object " + object + " are outside of its parts (line " +
                             std::to_string(line_of_part[group.object]) + " begins one)",
                         how_to_name);
      filled[group.object].insert(group.part);
    }
    for (std::size_t o = 1; o <= n_objects; ++o) {
      if (named[o].empty()) continue;
      for (int k = 0; k <= *named[o].rbegin(); ++k)
        if (!filled[o].contains(k))
          throw InputError({path_, line_of_part[o]},
                           "object " + mesh.object_names[o - 1] + " has parts up to number " +
                               std::to_string(*named[o].rbegin()) + " and no face of number " +
                               std::to_string(k),
                           how_to_name);
    }
  }

  std::string path_, object_;
  MeshBuilder builder_;
  std::map<std::string, int> line_of_object_;
  std::vector<int> line_of_group_{0};  // of the groups of the mesh
};

}  // namespace

Mesh parse_obj(const std::string& bytes, const std::string& path) {
  ObjParser parser(path);
  TextReader reader(bytes, path);
  for (std::string_view line; reader.next_line(line);) {
    const auto words = words_of(line.substr(0, line.find('#')));
    if (!words.empty()) parser.take(words, reader.where_of_line());
  }
  return parser.finished();
}

}  // namespace talus
