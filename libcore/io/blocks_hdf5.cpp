#include "io/blocks_hdf5.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/error.hpp"

namespace talus {
namespace {

constexpr const char* format_name = "talus-blocks";
constexpr int format_version = 1;

// Closes what it holds. HDF5 says failure by negative numbers; `what` goes into the message.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close, const Where& where, const char* what) : id_(id), close_(close) {
    if (id < 0) throw InputError(where, std::string("HDF5 cannot ") + what);
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: a handle is used as what it wraps
  // Closes with its check: what is written late fails here.
  void finish(const Where& where) {
    const hid_t id = id_;
    id_ = -1;
    if (close_(id) < 0) throw InputError(where, "HDF5 cannot finish the file", "is the disk full?");
  }

 private:
  hid_t id_;
  Close close_;
};

void check(herr_t code, const Where& where, const char* what) {
  if (code < 0) throw InputError(where, std::string("HDF5 cannot ") + what, "is the disk full?");
}

// HDF5 prints its error stack unless told not to.
// It also tidies up when the program ends, which goes on for ever after a damaged file; ours are
// closed by then.
class Quiet {
 public:
  Quiet() {
    static const herr_t once = H5dont_atexit();
    static_cast<void>(once);
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

struct Dataset {
  const char* name;
  const char* units;
  const char* description;
};

hid_t memory_type(const double*) { return H5T_NATIVE_DOUBLE; }
hid_t memory_type(const int*) { return H5T_NATIVE_INT; }
hid_t file_type(const double*) { return H5T_IEEE_F64LE; }
hid_t file_type(const int*) { return H5T_STD_I32LE; }

// --- writing -----------------------------------------------------------------------------------

class Writer {
 public:
  Writer(hid_t file, const std::string& path) : file_(file), path_(path) {}

  void text_attribute(hid_t owner, const char* name, const std::string& value) const {
    texts_attribute(owner, name, {value}, true);
  }

  // Texts of one length, padded with zeros.
  void texts_attribute(hid_t owner, const char* name, const std::vector<std::string>& values,
                       bool is_scalar = false) const {
    const Where where{path_, 0, name};
    std::size_t length = 1;
    for (const std::string& value : values) length = std::max(length, value.size() + 1);
    std::vector<char> bytes(length * values.size(), '\0');
    for (std::size_t i = 0; i < values.size(); ++i)
      std::memcpy(bytes.data() + i * length, values[i].data(), values[i].size());
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, where, "make a type");
    check(H5Tset_size(type, length), where, "make a type");
    check(H5Tset_cset(type, H5T_CSET_UTF8), where, "make a type");
    const hsize_t n = values.size();
    const Handle space(is_scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr),
                       H5Sclose, where, "make a space");
    const Handle attribute(H5Acreate2(owner, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                           where, "make an attribute");
    if (!bytes.empty()) check(H5Awrite(attribute, type, bytes.data()), where, "write an attribute");
  }

  template <class T>
  void numbers_attribute(hid_t owner, const char* name, const std::vector<T>& values) const {
    const Where where{path_, 0, name};
    const hsize_t n = values.size();
    const Handle space(H5Screate_simple(1, &n, nullptr), H5Sclose, where, "make a space");
    const Handle attribute(
        H5Acreate2(owner, name, file_type(values.data()), space, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose, where, "make an attribute");
    check(H5Awrite(attribute, memory_type(values.data()), values.data()), where,
          "write an attribute");
  }

  // Rows of `n_columns` numbers; 1 gives a plain array.
  template <class T>
  void array(const Dataset& about, const T* values, std::size_t n_rows,
             std::vector<hsize_t> columns = {}) const {
    const Where where{path_, 0, about.name};
    std::vector<hsize_t> shape = {n_rows};
    shape.insert(shape.end(), columns.begin(), columns.end());
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                       H5Sclose, where, "make a space");
    const Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, where, "make properties");
    check(H5Pset_obj_track_times(properties, false), where, "leave times out");
    if (n_rows > 256) {
      std::vector<hsize_t> chunk = shape;
      chunk[0] = std::min<hsize_t>(n_rows, 16384);
      check(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), where,
            "set the chunks");
      check(H5Pset_shuffle(properties), where, "shuffle");
      check(H5Pset_deflate(properties, 4), where, "compress");
      check(H5Pset_fletcher32(properties), where, "add checksums");
    }
    const Handle dataset(H5Dcreate2(file_, about.name, file_type(values), space, H5P_DEFAULT,
                                    properties, H5P_DEFAULT),
                         H5Dclose, where, "make the dataset");
    if (n_rows > 0)
      check(H5Dwrite(dataset, memory_type(values), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), where,
            "write");
    text_attribute(dataset, "units", about.units);
    text_attribute(dataset, "description", about.description);
  }
  void array(const Dataset& about, const std::vector<int>& values) const {
    array(about, values.data(), values.size());
  }
  void array(const Dataset& about, const std::vector<double>& values) const {
    array(about, values.data(), values.size());
  }
  void array(const Dataset& about, const std::vector<Vec3>& values) const {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    array(about, values.empty() ? static_cast<const double*>(nullptr) : values[0].data(),
          values.size(), {3});
  }
  // Symmetric, so that the order of rows and columns does not matter.
  void array(const Dataset& about, const std::vector<Mat3>& values) const {
    static_assert(sizeof(Mat3) == 9 * sizeof(double));
    array(about, values.empty() ? static_cast<const double*>(nullptr) : values[0].data(),
          values.size(), {3, 3});
  }
  void array(const Dataset& about, const std::vector<std::array<int, 2>>& values) const {
    array(about, values.empty() ? static_cast<const int*>(nullptr) : values[0].data(),
          values.size(), {2});
  }

 private:
  hid_t file_;
  std::string path_;
};

// --- reading -----------------------------------------------------------------------------------

class Reader {
 public:
  Reader(hid_t file, const std::string& path) : file_(file), path_(path) {
    check(H5Fget_filesize(file, &file_size_), {path}, "read the size of the file");
  }

  [[nodiscard]] std::vector<std::string> texts_attribute(const char* name) const {
    const Where where{path_, 0, name};
    const Handle attribute(H5Aopen(file_, name, H5P_DEFAULT), H5Aclose, where,
                           "find this attribute");
    const Handle type(H5Aget_type(attribute), H5Tclose, where, "read the type of");
    const Handle space(H5Aget_space(attribute), H5Sclose, where, "read the size of");
    const std::size_t length = H5Tget_size(type);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || n < 0 || n > 100000 ||
        length == 0 || length > 1 << 20)
      throw InputError(where, "is not a list of texts");
    std::vector<char> bytes(length * static_cast<std::size_t>(n));
    if (n > 0) check(H5Aread(attribute, type, bytes.data()), where, "read this attribute");
    std::vector<std::string> values;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
      values.emplace_back(bytes.data() + i * length, strnlen(bytes.data() + i * length, length));
    return values;
  }
  [[nodiscard]] std::string text_attribute(const char* name) const {
    const auto values = texts_attribute(name);
    if (values.size() != 1) throw InputError({path_, 0, name}, "is not one text");
    return values[0];
  }
  template <class T>
  void numbers_attribute(const char* name, T* values, hssize_t n) const {
    const Where where{path_, 0, name};
    const Handle attribute(H5Aopen(file_, name, H5P_DEFAULT), H5Aclose, where,
                           "find this attribute");
    const Handle space(H5Aget_space(attribute), H5Sclose, where, "read the size of");
    if (H5Sget_simple_extent_npoints(space) != n)
      throw InputError(where, "has not " + std::to_string(n) + " numbers");
    check(H5Aread(attribute, memory_type(values), values), where, "read this attribute");
  }

  // Reads all rows; `columns` is what must follow the number of rows in the shape.
  template <class T, class Entry>
  void array(const char* name, std::vector<Entry>& values,
             const std::vector<hsize_t>& columns) const {
    const Where where{path_, 0, name};
    const Handle dataset(H5Dopen2(file_, name, H5P_DEFAULT), H5Dclose, where, "find this dataset");
    const Handle space(H5Dget_space(dataset), H5Sclose, where, "read the size of");
    const int n_axes = H5Sget_simple_extent_ndims(space);
    std::vector<hsize_t> shape(static_cast<std::size_t>(std::max(n_axes, 0)));
    if (n_axes > 0)
      check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), where, "read the size of");
    if (shape.size() != columns.size() + 1 ||
        !std::equal(columns.begin(), columns.end(), shape.begin() + 1))
      throw InputError(where, "has another shape than expected");
    // Deflate makes nothing smaller than by 1032 times: a longer array is not in the file.
    if (shape[0] > (hsize_t{1} << 31) || shape[0] * sizeof(Entry) > 1100 * file_size_ + 4096)
      throw InputError(where, "is longer than the file can hold; the file is damaged");
    values.resize(static_cast<std::size_t>(shape[0]));
    if (values.empty()) return;
    check(H5Dread(dataset, memory_type(static_cast<T*>(nullptr)), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                  values.data()),
          where, "read this dataset; the file is damaged");
  }

 private:
  hid_t file_;
  std::string path_;
  hsize_t file_size_ = 0;
};

// The table of datasets, once for writing and reading: visit(about, field).
template <class Set, class Visit>
void for_each_array(Set& set, Visit&& visit) {  // clang-format off
  visit(Dataset{"vertices", "m", "vertices block by block, relative to origin_m"}, set.vertices);
  visit(Dataset{"block_vertex_begin", "1", "vertices of block b: [b] to [b + 1]"}, set.block_vertex_begin);
  visit(Dataset{"face_vertices", "1", "vertex indices of the faces of shells, counter-clockwise from outside"}, set.face_vertices);
  visit(Dataset{"face_begin", "1", "entries of face f in face_vertices: [f] to [f + 1]"}, set.face_begin);
  visit(Dataset{"joint_set", "1", "what made a face: joint set, -1 terrain, -2 failure surface, -3 within the rock"}, set.joint_set);
  visit(Dataset{"block_face_begin", "1", "faces of the shell of block b: [b] to [b + 1]"}, set.block_face_begin);
  visit(Dataset{"part_face_vertices", "1", "vertex indices of the faces of convex parts"}, set.part_face_vertices);
  visit(Dataset{"part_face_begin", "1", "entries of face f in part_face_vertices: [f] to [f + 1]"}, set.part_face_begin);
  visit(Dataset{"part_joint_set", "1", "what made a face of a part, as joint_set"}, set.part_joint_set);
  visit(Dataset{"part_begin", "1", "faces of convex part p: [p] to [p + 1]"}, set.part_begin);
  visit(Dataset{"convex_part_begin", "1", "convex parts of block b: [b] to [b + 1]"}, set.convex_part_begin);
  visit(Dataset{"material", "1", "index into material_names"}, set.material);
  visit(Dataset{"volume", "m3", "volume of the body"}, set.volume);
  visit(Dataset{"centroid", "m", "centre of mass, relative to origin_m"}, set.centroid);
  visit(Dataset{"second_moment", "m5", "integral of (x - c)(x - c)^T over the body"}, set.second_moment);
  visit(Dataset{"velocity", "m/s", "at the start"}, set.velocity);
  visit(Dataset{"spin", "rad/s", "at the start, about the axes of the map"}, set.spin);
  visit(Dataset{"pair_blocks", "1", "blocks that share a joint face before they move, a < b"}, set.pair_blocks);
  visit(Dataset{"pair_joint_set", "1", "joint set of the shared face"}, set.pair_joint_set);
  visit(Dataset{"pair_area", "m2", "shared area"}, set.pair_area);
  visit(Dataset{"pair_normal", "1", "unit normal from a to b"}, set.pair_normal);
  visit(Dataset{"pair_point", "m", "centre of the shared face, relative to origin_m"}, set.pair_point);
}  // clang-format on

struct ReadArray {
  const Reader& reader;
  void operator()(const Dataset& about, std::vector<int>& values) const {
    reader.array<int>(about.name, values, {});
  }
  void operator()(const Dataset& about, std::vector<double>& values) const {
    reader.array<double>(about.name, values, {});
  }
  void operator()(const Dataset& about, std::vector<Vec3>& values) const {
    reader.array<double>(about.name, values, {3});
  }
  void operator()(const Dataset& about, std::vector<Mat3>& values) const {
    reader.array<double>(about.name, values, {3, 3});
  }
  void operator()(const Dataset& about, std::vector<std::array<int, 2>>& values) const {
    reader.array<int>(about.name, values, {2});
  }
};

}  // namespace

void write_blocks(const std::string& path, const BlockSet& set,
                  const std::map<std::string, std::string>& tags) {
  const Quiet quiet;
  const Where where{path};
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, where, "make properties");
  check(H5Pset_obj_track_times(creation, false), where, "leave times out");
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, H5P_DEFAULT), H5Fclose, where,
              "make the file");
  const Writer writer(file, path);
  writer.text_attribute(file, "format", format_name);
  writer.numbers_attribute(file, "format_version", std::vector<int>{format_version});
  writer.text_attribute(file, "crs", set.crs_wkt);
  writer.text_attribute(file, "content_hash", set.content_hash);
  writer.numbers_attribute(file, "origin_m",
                           std::vector<double>{set.origin.x(), set.origin.y(), set.origin.z()});
  writer.texts_attribute(file, "ground_digests", set.ground_digests);
  writer.texts_attribute(file, "material_names", set.material_names);
  writer.texts_attribute(file, "joint_set_names", set.joint_set_names);
  for (const auto& [name, value] : tags) writer.text_attribute(file, name.c_str(), value);
  for_each_array(set,
                 [&](const Dataset& about, const auto& values) { writer.array(about, values); });
  check(H5Fflush(file, H5F_SCOPE_GLOBAL), where, "write the file");
  file.finish(where);
}

BlockSet read_blocks(const std::string& path) {
  const Quiet quiet;
  const Where where{path};
  if (H5Fis_hdf5(path.c_str()) <= 0)
    throw InputError(where, "is not an HDF5 file", "give a block set written by talus-blocks");
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, where, "make properties");
  // A damaged file may leave objects open inside the library: they go with the file.
  check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), where, "set how to close");
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, where,
                    "open the file; it may be cut short");
  const Reader reader(file, path);
  if (H5Aexists(file, "format") <= 0 || reader.text_attribute("format") != format_name)
    throw InputError(where, "is not a block set", "give a block set written by talus-blocks");
  int version = 0;
  reader.numbers_attribute("format_version", &version, 1);
  if (version != format_version)
    throw InputError(where,
                     "is a block set of version " + std::to_string(version) + ", expected " +
                         std::to_string(format_version),
                     "make it again with this talus-blocks");
  BlockSet set;
  set.crs_wkt = reader.text_attribute("crs");
  set.content_hash = reader.text_attribute("content_hash");
  reader.numbers_attribute("origin_m", set.origin.data(), 3);
  set.ground_digests = reader.texts_attribute("ground_digests");
  set.material_names = reader.texts_attribute("material_names");
  set.joint_set_names = reader.texts_attribute("joint_set_names");
  for_each_array(set, ReadArray{reader});
  const std::string broken = broken_promise(set);
  if (!broken.empty()) throw InputError(where, broken, "the file is damaged; make it again");
  return set;
}

}  // namespace talus
