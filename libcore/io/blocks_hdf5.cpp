// Writes and reads block sets as HDF5 files.
#include "io/blocks_hdf5.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include "base/error.hpp"
#include "base/write_bytes.hpp"
#include "io/h5_hdf5.hpp"

namespace talus {
namespace {

constexpr const char* format_name = "talus-blocks";
constexpr std::int64_t format_version = 2;

struct About {
  const char* name;
  const char* dimension;
  const char* units;
  const char* long_name;
};

// The table of datasets, once for writing and reading: visit(about, field).
template <class Set, class Visit>
void for_each_array(Set& set, Visit&& visit) {  // clang-format off
  visit(About{"vertices", "vertex", "m", "vertices block by block, relative to origin_m"}, set.vertices);
  visit(About{"block_vertex_begin", "block_bound", "1", "vertices of block b: [b] to [b + 1]"}, set.block_vertex_begin);
  visit(About{"face_vertices", "corner", "1", "vertex indices of the faces of shells, counter-clockwise from outside"}, set.face_vertices);
  visit(About{"face_begin", "face_bound", "1", "entries of face f in face_vertices: [f] to [f + 1]"}, set.face_begin);
  visit(About{"joint_set", "face", "1", "what made a face: joint set, -1 terrain, -2 failure surface, -3 within the rock, -4 side of the source"}, set.joint_set);
  visit(About{"block_face_begin", "block_bound", "1", "faces of the shell of block b: [b] to [b + 1]"}, set.block_face_begin);
  visit(About{"part_face_vertices", "part_corner", "1", "vertex indices of the faces of convex parts"}, set.part_face_vertices);
  visit(About{"part_face_begin", "part_face_bound", "1", "entries of face f in part_face_vertices: [f] to [f + 1]"}, set.part_face_begin);
  visit(About{"part_joint_set", "part_face", "1", "what made a face of a part, as joint_set"}, set.part_joint_set);
  visit(About{"part_begin", "part_bound", "1", "faces of convex part p: [p] to [p + 1]"}, set.part_begin);
  visit(About{"convex_part_begin", "block_bound", "1", "convex parts of block b: [b] to [b + 1]"}, set.convex_part_begin);
  visit(About{"material", "block", "1", "index into material_names"}, set.material);
  visit(About{"volume", "block", "m3", "volume of the body"}, set.volume);
  visit(About{"centroid", "block", "m", "centre of mass, relative to origin_m"}, set.centroid);
  visit(About{"second_moment", "block", "m5", "integral of (x - c)(x - c)^T over the body"}, set.second_moment);
  visit(About{"velocity", "block", "m/s", "at the start"}, set.velocity);
  visit(About{"spin", "block", "rad/s", "at the start, about the axes of the map"}, set.spin);
  visit(About{"pair_blocks", "pair", "1", "blocks that share a joint face before they move, a < b"}, set.pair_blocks);
  visit(About{"pair_joint_set", "pair", "1", "joint set of the shared face"}, set.pair_joint_set);
  visit(About{"pair_area", "pair", "m2", "shared area"}, set.pair_area);
  visit(About{"pair_normal", "pair", "1", "unit normal from a to b"}, set.pair_normal);
  visit(About{"pair_point", "pair", "m", "centre of the shared face, relative to origin_m"}, set.pair_point);
}  // clang-format on

// Entries of an array as the plain numbers that they consist of.
template <class Entry>
struct Plain {  // a number
  using Number = Entry;
  static constexpr std::size_t columns = 1;
  static Dimensions more() { return {}; }
};
template <class Number_, int Rows, int Cols>
struct Plain<Eigen::Matrix<Number_, Rows, Cols>> {  // symmetric ones: no matter how they are stored
  using Number = Number_;
  static constexpr std::size_t columns = Rows * Cols;
  static Dimensions more() {
    if (Cols == 1) return {{"axis", Rows}};
    return {{"axis", Rows}, {"axis_beside", Cols}};
  }
};
template <class Number_, std::size_t N>
struct Plain<std::array<Number_, N>> {
  using Number = Number_;
  static constexpr std::size_t columns = N;
  static Dimensions more() { return {{"block_of_pair", N}}; }
};

template <class Entry>
void write_array(H5Writer& file, const About& about, const std::vector<Entry>& values) {
  using Number = typename Plain<Entry>::Number;
  static_assert(sizeof(Entry) == Plain<Entry>::columns * sizeof(Number));
  const std::span<const Number> numbers(reinterpret_cast<const Number*>(values.data()),
                                        values.size() * Plain<Entry>::columns);
  Dimensions dimensions = Plain<Entry>::more();
  dimensions.insert(dimensions.begin(), {about.dimension, values.size()});
  file.array(about.name, numbers, dimensions, about.units, about.long_name);
}

template <class Entry>
void read_array(const H5Reader& file, const About& about, std::vector<Entry>& values) {
  using Number = typename Plain<Entry>::Number;
  const std::vector<Number> numbers = file.array<Number>(about.name, Plain<Entry>::columns);
  values.resize(numbers.size() / Plain<Entry>::columns);
  std::copy(numbers.begin(), numbers.end(), reinterpret_cast<Number*>(values.data()));
}

void check_format(const H5Reader& file, const std::string& path) {
  const std::string format = file.attribute_text("", "format");
  if (format != format_name)
    throw InputError({path}, "is of the format " + format + ", not a block set",
                     "give a block set written by talus-blocks");
  const std::int64_t version = file.attribute_integer("", "format_version");
  if (version != format_version)
    throw InputError({path},
                     "is a block set of version " + std::to_string(version) + ", expected " +
                         std::to_string(format_version),
                     "make it again with this talus-blocks");
}

}  // namespace

void write_blocks(const std::string& path, const BlockSet& set,
                  const std::map<std::string, std::string>& tags) {
  if (const std::string broken = broken_promise(set); !broken.empty())
    throw InputError({}, "the blocks cannot be what they must be: " + broken,
                     "look for heights, sizes or depths beyond what a slope has");
  H5Writer file;
  file.attribute("", "format", std::string(format_name));
  file.attribute("", "format_version", format_version);
  file.attribute("", "crs", set.crs_wkt);
  file.attribute("", "content_hash", set.content_hash);
  file.attribute("", "origin_m", std::span<const double>(set.origin.data(), 3));
  for (const auto& [name, value] : tags) file.attribute("", name, value);
  file.names("ground_digests", set.ground_digests, "ground",
             "of the terrains before and after the mass was taken out");
  file.names("material_names", set.material_names, "kind_of_material",
             "names of [material.NAME] of the site file");
  file.names("joint_set_names", set.joint_set_names, "kind_of_joint_set",
             "names of the joint sets");
  for_each_array(set,
                 [&](const About& about, const auto& values) { write_array(file, about, values); });
  if (!set.weight.empty())
    write_array(file, {"weight", "block", "1", "weight in statistics, e.g. events a year"},
                set.weight);
  file.save(path);
}

bool is_block_set(const std::string& path) {
  return H5Reader(path).attribute_text("", "format") == format_name;
}

BlockSet read_blocks(const std::string& path) {
  const H5Reader file(path);
  check_format(file, path);
  BlockSet set;
  set.crs_wkt = file.attribute_text("", "crs");
  set.content_hash = file.attribute_text("", "content_hash");
  const std::vector<double> origin = file.attribute_numbers("", "origin_m");
  if (origin.size() != 3) throw InputError({path, 0, "origin_m"}, "has not 3 numbers");
  set.origin = Vec3(origin[0], origin[1], origin[2]);
  set.ground_digests = file.texts("ground_digests");
  set.material_names = file.texts("material_names");
  set.joint_set_names = file.texts("joint_set_names");
  for_each_array(set, [&](const About& about, auto& values) { read_array(file, about, values); });
  if (file.has("weight")) read_array(file, {"weight", "block", "1", ""}, set.weight);
  const std::string broken = broken_promise(set);
  if (!broken.empty()) throw InputError({path}, broken, "the file is damaged; make it again");
  return set;
}

}  // namespace talus
