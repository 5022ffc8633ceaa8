// Reads vertices and faces of a PLY file, text or binary.
#include "io/ply.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/mesh_builder.hpp"

namespace talus {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are taken as they stand");

struct Type {
  std::size_t size = 0;  // 0: not a known type
  bool is_real = false, is_unsigned = false;
};

// A single number, or a list where its count has a type.
struct Property {
  std::string name;
  Type type, count_type;
};

struct Element {
  std::string name;
  std::int64_t n = 0;
  std::vector<Property> properties;
};

struct Header {
  std::string format;
  std::vector<Element> elements;
};

[[noreturn]] void refuse(const std::string& path, const std::string& finding) {
  throw InputError({path}, finding,
                   "write it anew: a TIN with talus-tin, a mesh with the program that it is from");
}

Type type_of(std::string_view name) {
  if (name == "float" || name == "float32") return {4, true};
  if (name == "double" || name == "float64") return {8, true};
  const bool is_unsigned = name.starts_with('u');
  if (is_unsigned) name.remove_prefix(1);
  if (name == "char" || name == "int8") return {1, false, is_unsigned};
  if (name == "short" || name == "int16") return {2, false, is_unsigned};
  if (name == "int" || name == "int32") return {4, false, is_unsigned};
  return {};
}

void read_element(const std::vector<std::string_view>& words, const std::string& path,
                  Header& header) {
  double n = -1;
  if (words.size() != 3 || !parse_double(words[2], n) || n != std::floor(n) ||
      !(n >= 0 && n <= std::numeric_limits<int>::max()))
    refuse(path, "an element of the PLY header has no valid number of entries");
  header.elements.push_back({std::string(words[1]), static_cast<std::int64_t>(n), {}});
}

void read_property(const std::vector<std::string_view>& words, const std::string& path,
                   Header& header) {
  const bool is_list = words.size() == 5 && words[1] == "list";
  Property property;
  if (is_list || words.size() == 3)
    property = {std::string(words.back()), type_of(words[words.size() - 2]),
                is_list ? type_of(words[2]) : Type()};
  if (header.elements.empty() || property.type.size == 0 ||
      (is_list && property.count_type.size == 0))
    refuse(path, "a property of the PLY header cannot be understood");
  header.elements.back().properties.push_back(std::move(property));
}

Header read_header(TextReader& reader, const std::string& path,
                   std::vector<std::string>& comments) {
  Header header;
  std::string_view line;
  if (!reader.next_line(line) || line != "ply")
    throw InputError({path}, "is not a PLY file (its first line is not \"ply\")",
                     "give a TIN written by talus-tin, or a raster that GDAL reads");
  constexpr std::string_view comment = "comment ";
  while (reader.next_line(line)) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty() || words[0] == "obj_info") continue;
    if (words[0] == "end_header") return header;
    if (words[0] == "format" && words.size() > 1)
      header.format = words[1];
    else if (words[0] == "element")
      read_element(words, path, header);
    else if (words[0] == "property")
      read_property(words, path, header);
    else if (line.starts_with(comment))
      comments.emplace_back(line.substr(comment.size()));
    else if (words[0] != "comment")
      refuse(path, "a line of the PLY header cannot be understood");
  }
  refuse(path, "the PLY header does not end, expected a line end_header");
}

// The numbers behind the header, one after the other, as words or bytes.
class Numbers {
 public:
  Numbers(std::string_view bytes, const TextReader& behind_header, const std::string& format,
          const std::string& path)
      : text_(behind_header),
        bytes_(bytes.substr(std::min(behind_header.at(), bytes.size()))),
        path_(path),
        is_text_(format == "ascii"),
        is_big_endian_(format == "binary_big_endian") {
    if (!is_text_ && !is_big_endian_ && format != "binary_little_endian")
      refuse(path, "the PLY format is \"" + format +
                       "\", expected ascii, binary_little_endian or binary_big_endian");
  }

  double next(const Type& type) {
    if (is_text_) return text_.next_number();
    if (type.size > bytes_.size()) refuse(path_, "the file ends early: it was truncated");
    const auto n_unused = 64 - 8 * type.size;  // bits
    std::uint64_t raw = 0;
    if (bytes_.size() >= sizeof raw)
      std::memcpy(&raw, bytes_.data(), sizeof raw);  // of one size, which is quicker
    else
      std::memcpy(&raw, bytes_.data(), type.size);
    bytes_.remove_prefix(type.size);
    raw = is_big_endian_ ? __builtin_bswap64(raw) >> n_unused : raw << n_unused >> n_unused;
    if (type.is_real)
      return type.size == 8 ? std::bit_cast<double>(raw)
                            : std::bit_cast<float>(static_cast<std::uint32_t>(raw));
    if (type.is_unsigned) return static_cast<double>(raw);
    return static_cast<double>(static_cast<std::int64_t>(raw << n_unused) >> n_unused);
  }

  // Bytes of a number, at least: as a word it takes two, with the separator from the next.
  [[nodiscard]] std::size_t least_bytes(const Type& type) const { return is_text_ ? 2 : type.size; }

  // Refuses a count that the rest of the file cannot hold, before anything is made room for.
  void expect(double n, std::size_t bytes_each, const std::string& what) const {
    const double n_left =
        is_text_ ? static_cast<double>(text_.n_left()) + 1 : static_cast<double>(bytes_.size());
    if (n * static_cast<double>(bytes_each) > n_left)
      refuse(path_, "the header promises " + text(n, 12) + " entries of " + what +
                        ", the file is too short for them: it was truncated");
  }

 private:
  TextReader text_;
  std::string_view bytes_;
  const std::string& path_;
  bool is_text_, is_big_endian_;
};

class PlyReader {
 public:
  PlyReader(Numbers numbers, const std::string& path, bool only_triangles, PlyFile& file)
      : numbers_(std::move(numbers)), path_(path), only_triangles_(only_triangles), file_(file) {}

  void read(const Element& element) {
    if (element.properties.empty()) return;
    std::size_t bytes_each = 0;
    for (const Property& property : element.properties)
      bytes_each +=
          numbers_.least_bytes(property.count_type.size > 0 ? property.count_type : property.type);
    numbers_.expect(static_cast<double>(element.n), bytes_each, element.name);
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    std::vector<int> roles;  // of a property: an axis, or of the list of corners
    for (const Property& property : element.properties)
      roles.push_back(role_of(property, is_vertex, is_face));
    if (is_vertex)
      for (const int axis : {0, 1, 2})
        if (std::count(roles.begin(), roles.end(), axis) == 0)
          refuse(path_, "element vertex lacks x, y or z");
    if (is_face && std::count(roles.begin(), roles.end(), corners) != 1)
      refuse(path_, "element face has no list vertex_indices");
    if (is_vertex) file_.points.reserve(static_cast<std::size_t>(element.n));
    if (is_face && only_triangles_) file_.triangles.reserve(static_cast<std::size_t>(element.n));
    for (std::int64_t i = 0; i < element.n; ++i) {
      for (std::size_t k = 0; k < roles.size(); ++k) read_value(element.properties[k], roles[k]);
      if (is_vertex) end_vertex();
      if (is_face) end_face();
    }
  }

 private:
  static constexpr int corners = 3, passed_over = 4;

  static int role_of(const Property& property, bool is_vertex, bool is_face) {
    const bool is_list = property.count_type.size > 0;
    if (is_face && is_list && property.name.starts_with("vertex_ind")) return corners;
    const std::size_t axis = std::string_view("xyz").find(property.name);
    const bool is_axis = is_vertex && !is_list && property.name.size() == 1 && axis < 3;
    return is_axis ? static_cast<int>(axis) : passed_over;
  }

  void read_value(const Property& property, int role) {
    if (property.count_type.size == 0) {
      const double value = numbers_.next(property.type);
      if (role < corners) point_[role] = value;
      return;
    }
    const double n = numbers_.next(property.count_type);
    if (!(n >= 0) || n != std::floor(n))
      refuse(path_, "a list has " + text(n) + " entries, expected a whole number");
    if (role == corners && only_triangles_ && n != 3)
      refuse(path_, face() + " has " + text(n) + " corners, expected triangles");
    numbers_.expect(n, numbers_.least_bytes(property.type), property.name);
    if (role == corners) loop_.clear();
    for (double k = 0; k < n; ++k) {
      const double value = numbers_.next(property.type);
      if (role == corners) add_corner(value);
    }
  }

  [[nodiscard]] std::string face() const { return "face " + std::to_string(n_faces_); }

  void add_corner(double corner) {
    const auto n_points = static_cast<std::int64_t>(file_.points.size());
    if (!(corner >= 0 && corner < static_cast<double>(n_points)) || corner != std::floor(corner))
      refuse(path_, face() + " has the corner " + text(corner) + ", expected 0 to " +
                        std::to_string(n_points - 1));
    loop_.push_back(static_cast<int>(corner));
  }

  void end_face() {
    ++n_faces_;
    if (only_triangles_) return file_.triangles.push_back({loop_[0], loop_[1], loop_[2]});
    file_.corners.insert(file_.corners.end(), loop_.begin(), loop_.end());
    file_.face_begin.push_back(static_cast<int>(file_.corners.size()));
  }

  void end_vertex() {
    if (!point_.allFinite())
      refuse(path_, "vertex " + std::to_string(file_.points.size()) +
                        " has a coordinate that is not finite");
    file_.points.push_back(point_);
  }

  Numbers numbers_;
  const std::string& path_;
  bool only_triangles_;
  PlyFile& file_;
  Vec3 point_ = Vec3::Zero();
  std::vector<int> loop_;
  std::int64_t n_faces_ = 0;
};

}  // namespace

PlyFile parse_ply_file(std::string_view bytes, const std::string& path, bool only_triangles) {
  PlyFile file;
  TextReader text(bytes, path);
  const Header header = read_header(text, path, file.comments);
  file.n_header_bytes = std::min(text.at(), bytes.size());
  PlyReader reader(Numbers(bytes, text, header.format, path), path, only_triangles, file);
  for (const Element& element : header.elements) reader.read(element);
  return file;
}

Mesh parse_ply(const std::string& bytes, const std::string& path) {
  const PlyFile file = parse_ply_file(bytes, path, false);
  MeshBuilder builder;
  for (const Vec3& point : file.points) builder.add_vertex(point, {path});
  for (std::size_t f = 0; f + 1 < file.face_begin.size(); ++f)
    builder.add_polygon(
        {file.corners.begin() + file.face_begin[f], file.corners.begin() + file.face_begin[f + 1]},
        {path, 0, "face " + std::to_string(f)});
  return builder.finished(path);
}

}  // namespace talus
