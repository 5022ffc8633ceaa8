#include "io/tin_ply.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in the machine's order");

// --- header --------------------------------------------------------------------------------------

struct Property {
  std::string name, type;  // of a list: the type of its entries
  std::string count_type;  // empty: one number
};

struct Element {
  std::string name;
  std::uint64_t n = 0;
  std::vector<Property> properties;
};

struct Header {
  std::vector<Element> elements;
  std::string crs, crs_wkt;  // one line, and all lines of the WKT
  std::string judged, accepted;
  bool has_origin = false;
  Vec3 origin = Vec3::Zero();
  std::size_t n_bytes = 0;  // up to and with the line end_header
  bool is_text = false;     // the data are words, not bytes
};

constexpr std::size_t bytes_of_face = 13;        // a count and three corners
constexpr std::size_t longest_header = 1 << 20;  // bytes; a WKT takes two thousand
constexpr std::size_t longest_line = 400;        // MeshLab gives up on lines of more than 500 bytes
constexpr std::string_view wkt_comment = "comment crs_wkt ";
constexpr std::string_view accepted_comment = "comment doubts_accepted ";

[[noreturn]] void refuse(const std::string& source, const std::string& finding) {
  throw InputError({source}, finding, "write the TIN anew with talus-tin");
}

// Bytes of a number of this type; 0 when there is no such type.
std::size_t size_of_type(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 16> sizes = {{{"char", 1},
                                                                               {"uchar", 1},
                                                                               {"int8", 1},
                                                                               {"uint8", 1},
                                                                               {"short", 2},
                                                                               {"ushort", 2},
                                                                               {"int16", 2},
                                                                               {"uint16", 2},
                                                                               {"int", 4},
                                                                               {"uint", 4},
                                                                               {"int32", 4},
                                                                               {"uint32", 4},
                                                                               {"float", 4},
                                                                               {"float32", 4},
                                                                               {"double", 8},
                                                                               {"float64", 8}}};
  for (const auto& [name, size] : sizes)
    if (name == type) return size;
  return 0;
}

bool is_whole_type(std::string_view type) {
  return type.find("float") == type.npos && type != "double";
}

// The next line without its end; false at the end of the header's longest size or of the file.
bool next_line(std::span<const char> bytes, std::size_t& at, std::string& line) {
  const std::size_t limit = std::min(bytes.size(), longest_header);
  const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  const auto last = bytes.begin() + static_cast<std::ptrdiff_t>(limit);
  const auto end = std::find(begin, last, '\n');
  if (end == last) return false;
  line.assign(begin, end);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  at += static_cast<std::size_t>(end - begin) + 1;
  return true;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

void read_element(const std::vector<std::string>& words, const std::string& source,
                  Header& header) {
  double n = -1;
  const bool fits = words.size() == 3 && parse_double(words[2], n) && n >= 0 &&
                    n <= std::numeric_limits<int>::max() && n == std::floor(n);
  if (!fits) refuse(source, "an element of the PLY header has no valid number of entries");
  header.elements.push_back({words[1], static_cast<std::uint64_t>(n), {}});
}

void read_property(const std::vector<std::string>& words, const std::string& source,
                   Header& header) {
  Property property;
  if (words.size() == 5 && words[1] == "list")
    property = {words[4], words[3], words[2]};
  else if (words.size() == 3)
    property = {words[2], words[1], {}};
  const bool known = size_of_type(property.type) > 0 &&
                     (property.count_type.empty() || size_of_type(property.count_type) > 0);
  if (header.elements.empty() || !known)
    refuse(source, "a property of the PLY header cannot be understood");
  header.elements.back().properties.push_back(property);
}

void read_comment(const std::string& line, const std::vector<std::string>& words,
                  const std::string& source, Header& header) {
  if (line.starts_with(wkt_comment)) {
    header.crs_wkt += line.substr(wkt_comment.size());
  } else if (line.starts_with(accepted_comment)) {
    header.accepted += line.substr(accepted_comment.size());
  } else if (words.size() == 3 && words[1] == "heights_judged") {
    header.judged = words[2];
  } else if (words.size() > 2 && words[1] == "crs") {
    header.crs = line.substr(line.find("crs") + 4);
  } else if (words.size() == 5 && words[1] == "origin_m") {
    for (std::size_t k = 0; k < 3; ++k)
      if (!parse_double(words[k + 2], header.origin[static_cast<Eigen::Index>(k)]))
        refuse(source, "origin_m of the PLY header is \"" + line + "\", expected three numbers");
    header.has_origin = true;
  }
}

Header read_header(std::span<const char> bytes, const std::string& source) {
  Header header;
  std::string line, format;
  if (!next_line(bytes, header.n_bytes, line) || line != "ply")
    throw InputError({source}, "is not a PLY file (its first line is not \"ply\")",
                     "give a TIN written by talus-tin, or a raster that GDAL reads");
  while (true) {
    if (!next_line(bytes, header.n_bytes, line))
      refuse(source, "the PLY header does not end, expected a line end_header");
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format" && words.size() > 1) format = words[1];
    if (words[0] == "comment") read_comment(line, words, source, header);
    if (words[0] == "element") read_element(words, source, header);
    if (words[0] == "property") read_property(words, source, header);
  }
  header.is_text = format == "ascii";
  if (format != "binary_little_endian" && !header.is_text)
    refuse(source, "the PLY format is \"" + format + "\", expected binary_little_endian or ascii");
  return header;
}

// --- data ----------------------------------------------------------------------------------------

// The bytes behind the header, never read past their end.
class Cursor {
 public:
  Cursor(std::span<const char> bytes, const std::string& source) : bytes_(bytes), source_(source) {}

  [[nodiscard]] const char* take(std::size_t n) {
    if (n > bytes_.size()) refuse(source_, "the file ends before its data does: it was truncated");
    const char* at = bytes_.data();
    bytes_ = bytes_.subspan(n);
    return at;
  }
  // Refuses a count that the rest of the file cannot hold, before anything is made room for.
  void expect(std::uint64_t n, std::size_t bytes_each, const std::string& what) const {
    if (bytes_each > 0 && n > bytes_.size() / bytes_each)
      refuse(source_, "the header promises " + std::to_string(n) + " " + what +
                          ", the file is too short for them: it was truncated");
  }

 private:
  std::span<const char> bytes_;
  const std::string& source_;
};

template <class T>
double as_double(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

// Found once for a property: a file holds millions of its numbers.
using NumberReader = double (*)(const char*);

NumberReader reader_of(std::string_view type) {
  const bool is_unsigned = type.front() == 'u';
  switch (size_of_type(type)) {
    case 1:
      return is_unsigned ? as_double<std::uint8_t> : as_double<std::int8_t>;
    case 2:
      return is_unsigned ? as_double<std::uint16_t> : as_double<std::int16_t>;
    case 8:
      return as_double<double>;
    default:
      break;
  }
  if (!is_whole_type(type)) return as_double<float>;
  return is_unsigned ? as_double<std::uint32_t> : as_double<std::int32_t>;
}

// Bytes of an entry's plain numbers; refuses lists among them.
std::size_t stride_of(std::span<const Property> properties, const std::string& element,
                      const std::string& source) {
  std::size_t stride = 0;
  for (const Property& property : properties) {
    if (!property.count_type.empty())
      refuse(source, "element " + element + " has the list " + property.name +
                         ", expected plain numbers only");
    stride += size_of_type(property.type);
  }
  return stride;
}

void read_points(const Element& element, const std::string& source, Cursor& cursor, Tin& tin) {
  const std::size_t stride = stride_of(element.properties, element.name, source);
  std::array<std::size_t, 3> offset{};
  std::array<NumberReader, 3> read{};
  std::size_t at = 0;
  for (const Property& property : element.properties) {
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.name.size() == 1 && axis < 3)
      offset[axis] = at, read[axis] = reader_of(property.type);
    at += size_of_type(property.type);
  }
  if (read[0] == nullptr || read[1] == nullptr || read[2] == nullptr)
    refuse(source, "element vertex lacks x, y or z");
  cursor.expect(element.n, stride, "vertices");
  tin.points.resize(element.n);
  for (std::size_t i = 0; i < tin.points.size(); ++i) {
    const char* entry = cursor.take(stride);
    for (std::size_t k = 0; k < 3; ++k)
      tin.points[i][static_cast<Eigen::Index>(k)] = read[k](entry + offset[k]);
    if (!tin.points[i].allFinite())
      refuse(source, "vertex " + std::to_string(i) + " has a coordinate that is not finite");
  }
}

int corner_of(double corner, std::size_t face, const std::string& source, const Tin& tin) {
  if (corner >= 0 && corner < static_cast<double>(tin.points.size()) &&
      corner == std::floor(corner))
    return static_cast<int>(corner);
  refuse(source, "face " + std::to_string(face) + " has the corner " + text(corner) +
                     ", expected 0 to " +
                     std::to_string(static_cast<std::int64_t>(tin.points.size()) - 1));
}

void check_corners(const std::array<int, 3>& corners, std::size_t face, const std::string& source) {
  const auto& [a, b, c] = corners;
  if (a == b || b == c || a == c)
    refuse(source, "face " + std::to_string(face) + " has one corner twice");
}

void read_triangles(const Element& element, const std::string& source, Cursor& cursor, Tin& tin) {
  const bool has_list = !element.properties.empty() && !element.properties[0].count_type.empty() &&
                        is_whole_type(element.properties[0].type) &&
                        is_whole_type(element.properties[0].count_type);
  if (!has_list || !element.properties[0].name.starts_with("vertex_ind"))
    refuse(source, "element face does not begin with the list vertex_indices of whole numbers");
  const Property& list = element.properties[0];
  const std::size_t count_size = size_of_type(list.count_type),
                    index_size = size_of_type(list.type);
  const NumberReader read_count = reader_of(list.count_type), read_index = reader_of(list.type);
  const std::size_t rest =
      stride_of(std::span(element.properties).subspan(1), element.name, source);
  cursor.expect(element.n, count_size + 3 * index_size + rest, "faces");
  tin.triangles.resize(element.n);
  for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
    const double n_corners = read_count(cursor.take(count_size));
    if (n_corners != 3)
      refuse(source, "face " + std::to_string(t) + " has " + text(n_corners) +
                         " corners, expected triangles");
    const char* entry = cursor.take(3 * index_size + rest);
    for (std::size_t k = 0; k < 3; ++k)
      tin.triangles[t][k] = corner_of(read_index(entry + k * index_size), t, source, tin);
    check_corners(tin.triangles[t], t, source);
  }
}

void pass_over(const Element& element, const std::string& source, Cursor& cursor) {
  const std::size_t stride = stride_of(element.properties, element.name, source);
  cursor.expect(element.n, stride, "entries of element " + element.name);
  static_cast<void>(cursor.take(stride * element.n));
}

// --- data as text --------------------------------------------------------------------------------

// Bytes that are no text as question marks: a message must not end at a zero byte.
std::string printable(std::string_view word) {
  std::string shown(word);
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < 0x20 || c > 0x7e; }, '?');
  return shown;
}

// Words behind the header; lines do not matter.
class WordCursor {
 public:
  WordCursor(std::span<const char> bytes, const std::string& source)
      : rest_(bytes.data(), bytes.size()), source_(source) {}

  double take_number() {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t begin = std::min(rest_.find_first_not_of(blanks), rest_.size());
    const std::size_t end = std::min(rest_.find_first_of(blanks, begin), rest_.size());
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    double value = 0;
    if (word.empty()) refuse(source_, "the file ends before its data does: it was truncated");
    if (!parse_double(word, value))
      refuse(source_, "\"" + printable(word.substr(0, 40)) + "\" is no number");
    return value;
  }
  // A number takes two bytes, with what parts it from the next.
  void expect(std::uint64_t n, const std::string& what) const {
    if (n > rest_.size() / 2 + 1)
      refuse(source_, "the header promises " + std::to_string(n) + " " + what +
                          ", the file is too short for them: it was truncated");
  }

 private:
  std::string_view rest_;
  const std::string& source_;
};

void read_points(const Element& element, const std::string& source, WordCursor& words, Tin& tin) {
  static_cast<void>(stride_of(element.properties, element.name, source));  // plain numbers only
  std::array<bool, 3> has{};
  words.expect(element.n, "vertices");
  tin.points.resize(element.n);
  for (Vec3& point : tin.points)
    for (const Property& property : element.properties) {
      const double value = words.take_number();
      const std::size_t axis = std::string_view("xyz").find(property.name);
      if (property.name.size() != 1 || axis >= 3) continue;
      point[static_cast<Eigen::Index>(axis)] = value;
      has[axis] = true;
    }
  if (!(has[0] && has[1] && has[2])) refuse(source, "element vertex lacks x, y or z");
}

void read_triangles(const Element& element, const std::string& source, WordCursor& words,
                    Tin& tin) {
  if (element.properties.empty() || element.properties[0].count_type.empty() ||
      !element.properties[0].name.starts_with("vertex_ind"))
    refuse(source, "element face does not begin with the list vertex_indices of whole numbers");
  words.expect(element.n, "faces");
  tin.triangles.resize(element.n);
  for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
    const double n_corners = words.take_number();
    if (n_corners != 3)
      refuse(source, "face " + std::to_string(t) + " has " + text(n_corners) +
                         " corners, expected triangles");
    for (int& corner : tin.triangles[t]) corner = corner_of(words.take_number(), t, source, tin);
    for (std::size_t k = 1; k < element.properties.size(); ++k)
      static_cast<void>(words.take_number());
    check_corners(tin.triangles[t], t, source);
  }
}

void pass_over(const Element& element, WordCursor& words) {
  for (std::uint64_t i = 0; i < element.n; ++i)
    for (const Property& property : element.properties) {
      const auto n = static_cast<std::uint64_t>(
          property.count_type.empty() ? 1 : std::max(0.0, words.take_number()));
      for (std::uint64_t k = 0; k < n; ++k) static_cast<void>(words.take_number());
    }
}

void pass_over(const Element& element, const std::string&, WordCursor& words) {
  pass_over(element, words);
}

template <class AnyCursor>
void read_elements(const Header& header, const std::string& source, AnyCursor& cursor, Tin& tin) {
  bool has_vertices = false, has_faces = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex" && !has_vertices) {
      read_points(element, source, cursor, tin);
      has_vertices = true;
    } else if (element.name == "face" && has_vertices && !has_faces) {
      read_triangles(element, source, cursor, tin);
      has_faces = true;
    } else {
      pass_over(element, source, cursor);
    }
  }
}

void make_relative(const Header& header, Tin& tin) {
  tin.origin = header.origin;
  if (!header.has_origin && !tin.points.empty()) {
    Vec3 low = tin.points.front();
    for (const Vec3& p : tin.points) low = low.cwiseMin(p);
    tin.origin = Vec3(std::floor(low.x() / 100) * 100, std::floor(low.y() / 100) * 100, 0);
  }
  for (Vec3& p : tin.points) p -= tin.origin;
}

void turn_clockwise_triangles(Tin& tin) {
  for (auto& [a, b, c] : tin.triangles) {
    const Vec3 u = tin.points[b] - tin.points[a];
    const Vec3 v = tin.points[c] - tin.points[a];
    if (cross(u.head<2>(), v.head<2>()) < 0) std::swap(b, c);
  }
}

// Small entries to a file through one buffer, so that a TIN needs no second copy to be written.
class EntryWriter {
 public:
  explicit EntryWriter(std::ofstream& file) : file_(file) { buffer_.reserve(size); }
  void add(const void* entry, std::size_t n_bytes) {
    if (buffer_.size() + n_bytes > size) flush();
    const auto* const bytes = static_cast<const char*>(entry);
    buffer_.insert(buffer_.end(), bytes, bytes + n_bytes);
  }
  void flush() {
    file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

 private:
  static constexpr std::size_t size = 1 << 18;
  std::ofstream& file_;
  std::vector<char> buffer_;
};

// Calls visit(bytes, n_bytes) for what stands behind the header, in order.
template <class Visit>
void for_each_entry(const Tin& tin, const Visit& visit) {
  for (const Vec3& point : tin.points) {
    const Vec3 on_map = point + tin.origin;
    visit(on_map.data(), 3 * sizeof(double));
  }
  std::array<char, bytes_of_face> face = {3};  // its count of corners
  for (const auto& corners : tin.triangles) {
    static_assert(sizeof corners + 1 == bytes_of_face);
    std::memcpy(face.data() + 1, corners.data(), sizeof corners);
    visit(face.data(), face.size());
  }
}

// The code at the end of a WKT that has one for the whole system; empty when it has none.
std::string epsg_code(const std::string& wkt) {
  constexpr std::string_view begin = "ID[\"EPSG\",", end = "]]";
  const std::size_t at = wkt.rfind(begin);
  if (at == wkt.npos || !wkt.ends_with(end)) return {};
  const std::size_t first = at + begin.size();
  const std::string code = wkt.substr(first, wkt.size() - end.size() - first);
  return code.find_first_not_of("0123456789") == code.npos ? code : std::string();
}

std::string in_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string comment_lines(std::string_view comment, const std::string& text) {
  std::string lines;
  for (std::size_t at = 0; at < text.size(); at += longest_line)
    lines += std::string(comment) + text.substr(at, longest_line) + "\n";
  return lines;
}

std::string header_text(const Tin& tin, const std::string& digest) {
  const std::string wkt = in_one_line(tin.crs_wkt);
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  const std::string code = epsg_code(wkt);
  if (!code.empty()) header += "comment crs EPSG:" + code + "\n";
  header += comment_lines(wkt_comment, wkt) + "comment heights_judged " + digest + "\n" +
            comment_lines(accepted_comment, in_one_line(tin.accepted_doubts));
  header += "comment origin_m " + text(tin.origin.x()) + " " + text(tin.origin.y()) + " " +
            text(tin.origin.z()) + "\n";
  header += "element vertex " + std::to_string(tin.points.size()) +
            "\nproperty double x\nproperty double y\nproperty double z\n";
  header += "element face " + std::to_string(tin.triangles.size()) +
            "\nproperty list uchar int vertex_indices\nend_header\n";
  return header;
}

}  // namespace

void write_tin(const std::string& path, const Tin& tin) {
  Sha256 digest;
  for_each_entry(tin, [&digest](const void* bytes, std::size_t n) { digest.add(bytes, n); });
  std::ofstream file(path, std::ios::binary);
  file << header_text(tin, digest.hex());
  EntryWriter writer(file);
  for_each_entry(tin, [&writer](const void* bytes, std::size_t n) { writer.add(bytes, n); });
  writer.flush();
  file.close();
  if (!file)
    throw InputError({path}, "cannot be written to its end",
                     "is the disk full, or the folder closed?");
}

Tin parse_tin(std::span<const char> bytes, const std::string& source) {
  const Header header = read_header(bytes, source);
  const std::span<const char> data = bytes.subspan(header.n_bytes);
  Tin tin;
  if (header.is_text) {
    WordCursor words(data, source);
    read_elements(header, source, words, tin);
  } else {
    Cursor cursor(data, source);
    read_elements(header, source, cursor, tin);
  }
  if (tin.points.empty() || tin.triangles.empty())
    throw InputError(
        {source}, "the PLY file has no vertices followed by faces",
        tin.triangles.empty()
            ? "export it with faces; points alone as text x,y,z, for talus-tin --points"
            : "write the TIN anew with talus-tin");
  make_relative(header, tin);
  turn_clockwise_triangles(tin);
  tin.crs_wkt = header.crs_wkt.empty() ? header.crs : header.crs_wkt;
  if (!header.judged.empty()) {
    Sha256 digest;
    digest.add(data.data(), data.size());
    tin.is_judged = digest.hex() == header.judged;
  }
  if (tin.is_judged) tin.accepted_doubts = header.accepted;
  return tin;
}

Tin read_tin(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff n_bytes = file ? static_cast<std::streamoff>(file.tellg()) : -1;
  if (n_bytes < 0) throw InputError({path}, "cannot be read");
  std::vector<char> bytes(static_cast<std::size_t>(n_bytes));
  file.seekg(0);
  file.read(bytes.data(), n_bytes);
  if (!file) throw InputError({path}, "reading failed before its end");
  return parse_tin(bytes, path);
}

}  // namespace talus
