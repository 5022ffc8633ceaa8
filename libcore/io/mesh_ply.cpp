// io/mesh.hpp for PLY, binary and text.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/mesh_builder.hpp"

namespace talus {
namespace {

enum class Format { text, little_endian, big_endian };

struct Property {
  std::string name, type;
  std::string count_type;  // of a list; empty for a single value
};
struct Element {
  std::string name;
  std::int64_t n = 0;
  std::vector<Property> properties;
};
struct Header {
  Format format = Format::text;
  std::vector<Element> elements;
};

int size_of(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "int" || type == "uint" || type == "int32" || type == "uint32" || type == "float" ||
      type == "float32")
    return 4;
  if (type == "double" || type == "float64") return 8;
  return 0;
}

// Reads values one after the other, as text or as bytes.
class ValueReader {
 public:
  ValueReader(const std::string& bytes, std::size_t begin, Format format, const std::string& path)
      : text_(std::string_view(bytes).substr(begin), path),
        bytes_(bytes),
        at_(begin),
        format_(format),
        path_(path) {}

  double next(const std::string& type) {
    if (format_ == Format::text) return text_.next_number();
    const auto size = static_cast<std::size_t>(size_of(type));
    if (at_ + size > bytes_.size()) throw InputError({path_}, "the file ends early");
    std::uint64_t raw = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t shift = format_ == Format::little_endian ? k : size - 1 - k;
      raw |= std::uint64_t{static_cast<unsigned char>(bytes_[at_ + k])} << (8 * shift);
    }
    at_ += size;
    if (type == "float" || type == "float32")
      return std::bit_cast<float>(static_cast<std::uint32_t>(raw));
    if (type == "double" || type == "float64") return std::bit_cast<double>(raw);
    if (type[0] == 'u') return static_cast<double>(raw);
    const auto unused = static_cast<int>(64 - 8 * size);  // sign extension
    return static_cast<double>(static_cast<std::int64_t>(raw << unused) >> unused);
  }
  [[nodiscard]] std::int64_t n_left() const {
    return format_ == Format::text ? text_.n_left()
                                   : static_cast<std::int64_t>(bytes_.size() - at_);
  }
  [[nodiscard]] Where where(const Element& element, std::int64_t number) const {
    return {path_, 0, element.name + " " + std::to_string(number + 1)};
  }

 private:
  TextReader text_;
  const std::string& bytes_;
  std::size_t at_;
  Format format_;
  std::string path_;
};

void read_property(const std::vector<std::string_view>& words, Header& header, const Where& where) {
  if (header.elements.empty()) throw InputError(where, "a property stands before any element");
  Property property;
  if (words.size() == 5 && words[1] == "list")
    property = {std::string(words[4]), std::string(words[3]), std::string(words[2])};
  else if (words.size() == 3)
    property = {std::string(words[2]), std::string(words[1]), ""};
  else
    throw InputError(where, "a property that cannot be understood");
  if (size_of(property.type) == 0 ||
      (!property.count_type.empty() && size_of(property.count_type) == 0))
    throw InputError(where, "the type of property " + property.name + " is not known");
  header.elements.back().properties.push_back(std::move(property));
}

Header read_header(TextReader& reader, const std::string& path) {
  Header header;
  std::string_view line;
  if (!reader.next_line(line) || line != "ply")
    throw InputError({path, 1}, "the file does not begin with ply");
  while (reader.next_line(line)) {
    const auto words = words_of(line);
    const Where where = reader.where_of_line();
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") return header;
    if (words[0] == "format" && words.size() >= 2) {
      if (words[1] == "ascii")
        header.format = Format::text;
      else if (words[1] == "binary_little_endian")
        header.format = Format::little_endian;
      else if (words[1] == "binary_big_endian")
        header.format = Format::big_endian;
      else
        throw InputError(where, "the format is not known");
    } else if (words[0] == "element" && words.size() == 3) {
      double n = 0;
      if (!parse_double(words[2], n) || !(n >= 0 && n <= 1e12) || n != std::floor(n))
        throw InputError(where, "the number of elements is not a whole number");
      header.elements.push_back({std::string(words[1]), static_cast<std::int64_t>(n), {}});
    } else if (words[0] == "property") {
      read_property(words, header, where);
    } else {
      throw InputError(where, "a line of the header that cannot be understood");
    }
  }
  throw InputError({path}, "the header has no end_header");
}

// One element of any kind: its single values by property, and the list that names vertices.
void read_element(ValueReader& reader, const Element& element, const Where& where, Vec3& point,
                  std::vector<std::int64_t>& loop) {
  for (const Property& property : element.properties) {
    if (property.count_type.empty()) {
      const double value = reader.next(property.type);
      if (property.name == "x") point.x() = value;
      if (property.name == "y") point.y() = value;
      if (property.name == "z") point.z() = value;
      continue;
    }
    const double count = reader.next(property.count_type);
    if (!(count >= 0 && count <= static_cast<double>(reader.n_left())) ||
        count != std::floor(count))
      throw InputError(where, "a list of " + text(count) + " entries does not fit into the file");
    const bool is_face = property.name == "vertex_indices" || property.name == "vertex_index";
    if (is_face) loop.clear();
    for (auto k = static_cast<std::int64_t>(count); k > 0; --k) {
      const double value = reader.next(property.type);
      if (!is_face) continue;
      if (!(std::abs(value) <= 4e15) || value != std::floor(value))
        throw InputError(where, "a vertex number is not a whole number");
      loop.push_back(static_cast<std::int64_t>(value));
    }
  }
}

}  // namespace

Mesh parse_ply(const std::string& bytes, const std::string& path) {
  TextReader head(bytes, path);
  const Header header = read_header(head, path);
  ValueReader reader(bytes, std::min(head.at(), bytes.size()), header.format, path);
  MeshBuilder builder;
  for (const Element& element : header.elements) {
    if (element.properties.empty()) continue;
    if (element.n > reader.n_left()) throw InputError({path}, "the file ends early");
    for (std::int64_t i = 0; i < element.n; ++i) {
      const Where where = reader.where(element, i);
      Vec3 point = Vec3::Constant(NAN);
      std::vector<std::int64_t> loop;
      read_element(reader, element, where, point, loop);
      if (element.name == "vertex") builder.add_vertex(point, where);
      if (element.name == "face") builder.add_polygon(loop, where);
    }
  }
  return builder.finished(path);
}

}  // namespace talus
