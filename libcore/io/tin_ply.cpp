// Writes and reads a TIN as binary PLY.
#include "io/tin_ply.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "geometry/plan2d.hpp"
#include "io/mesh_builder.hpp"
#include "io/ply.hpp"

namespace talus {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in the machine's order");

constexpr std::size_t bytes_of_face = 13;  // a count and three corners
constexpr std::size_t longest_line = 400;  // MeshLab gives up on lines of more than 500 bytes
constexpr std::string_view wkt_comment = "crs_wkt ", accepted_comment = "doubts_accepted ";

// Content of the comments of a header.
struct Said {
  std::string crs, crs_wkt;  // one line, and all lines of the WKT
  std::string judged, accepted;
  std::optional<Vec3> origin;
};

Said said_in(const std::vector<std::string>& comments, const std::string& source) {
  Said said;
  for (const std::string& comment : comments) {
    const std::vector<std::string_view> words = words_of(comment);
    if (comment.starts_with(wkt_comment)) {
      said.crs_wkt += comment.substr(wkt_comment.size());
    } else if (comment.starts_with(accepted_comment)) {
      said.accepted += comment.substr(accepted_comment.size());
    } else if (words.size() == 2 && words[0] == "heights_judged") {
      said.judged = words[1];
    } else if (words.size() > 1 && words[0] == "crs") {
      said.crs = comment.substr(comment.find("crs") + 4);
    } else if (words.size() == 4 && words[0] == "origin_m") {
      Vec3& origin = said.origin.emplace();
      for (std::size_t k = 0; k < 3; ++k)
        if (!parse_double(words[k + 1], origin[static_cast<Eigen::Index>(k)]))
          throw InputError({source}, "the PLY header says " + comment + ", expected three numbers",
                           "write the TIN anew with talus-tin");
    }
  }
  return said;
}

void check_corners(const std::vector<std::array<int, 3>>& triangles, const std::string& source) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    if (a == b || b == c || a == c)
      throw InputError({source}, "face " + std::to_string(t) + " has one corner twice",
                       "write the TIN anew with talus-tin");
  }
}

Vec3 origin_of(const std::vector<Vec3>& points) {
  Vec3 low = points.front();
  for (const Vec3& p : points) low = low.cwiseMin(p);
  return {std::floor(low.x() / 100) * 100, std::floor(low.y() / 100) * 100, 0};
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

// Calls visit(bytes, n_bytes) for the data after the header, in order.
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
    lines += "comment " + std::string(comment) + text.substr(at, longest_line) + "\n";
  return lines;
}

std::string header_text(const Tin& tin, const std::string& digest) {
  std::string header = "ply\nformat binary_little_endian 1.0\n" + crs_comments(tin.crs_wkt) +
                       "comment heights_judged " + digest + "\n" +
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

std::string crs_comments(const std::string& crs_wkt) {
  const std::string wkt = in_one_line(crs_wkt), code = epsg_code(wkt);
  return (code.empty() ? "" : "comment crs EPSG:" + code + "\n") + comment_lines(wkt_comment, wkt);
}

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

Tin parse_tin(std::string_view bytes, const std::string& source) {
  PlyFile file = parse_ply_file(bytes, source, true);
  if (file.points.empty() || file.triangles.empty())
    throw InputError(
        {source}, "the PLY file has no vertices followed by faces",
        file.triangles.empty()
            ? "export it with faces; points alone as text x,y,z, for talus-tin --points"
            : "write the TIN anew with talus-tin");
  const Said said = said_in(file.comments, source);
  check_corners(file.triangles, source);
  Tin tin;
  tin.triangles = std::move(file.triangles);
  tin.origin = said.origin ? *said.origin : origin_of(file.points);
  tin.points = std::move(file.points);
  for (Vec3& p : tin.points) p -= tin.origin;
  turn_clockwise_triangles(tin);
  tin.crs_wkt = said.crs_wkt.empty() ? said.crs : said.crs_wkt;
  if (!said.judged.empty()) {
    Sha256 digest;
    digest.add(bytes.data() + file.n_header_bytes, bytes.size() - file.n_header_bytes);
    tin.is_judged = digest.hex() == said.judged;
  }
  if (tin.is_judged) tin.accepted_doubts = said.accepted;
  return tin;
}

Tin read_tin(const std::string& path) { return parse_tin(read_file(path), path); }

}  // namespace talus
