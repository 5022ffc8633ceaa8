// Writes and reads HDF5: arrays with dimensions, units and names; attributes; checks.
#include "io/h5_hdf5.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <type_traits>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/write_bytes.hpp"
#include "io/seal.hpp"

namespace talus {
namespace {

// An HDF5 identifier that is closed with its scope.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Id(Id&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
  Id& operator=(Id&&) = delete;
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] operator hid_t() const { return id_; }
  [[nodiscard]] bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// The library prints its error stack unless told not to.
void silence() {
  static const bool done = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  static_cast<void>(done);
}

template <class T>
hid_t native_type();
template <>
hid_t native_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}
template <>
hid_t native_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t native_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t native_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t native_type<double>() {
  return H5T_NATIVE_DOUBLE;
}

// Little-endian in the file, whatever the machine.
hid_t file_type(hid_t native) {
  if (native == H5T_NATIVE_UINT8) return H5T_STD_U8LE;
  if (native == H5T_NATIVE_INT32) return H5T_STD_I32LE;
  if (native == H5T_NATIVE_INT64) return H5T_STD_I64LE;
  return native == H5T_NATIVE_FLOAT ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
}

Id text_type(std::size_t length) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(1, length));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Shape shape_of(const Dimensions& dimensions) {
  Shape shape;
  for (const Dimension& dimension : dimensions) shape.push_back(dimension.extent);
  return shape;
}

std::size_t product(const Shape& shape) {
  std::size_t n = 1;
  for (const std::size_t extent : shape) n *= extent;
  return n;
}

// Building a file in memory fails for want of memory or by a slip of ours only.
void require(bool success, const std::string& what) {
  if (!success) throw std::runtime_error("HDF5: " + what + " failed");
}

}  // namespace

// --- writing -----------------------------------------------------------------------------------

struct H5Writer::Impl {
  Id file{-1, H5Fclose};

  static Id memory_file() {
    silence();
    Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    require(H5Pset_fapl_core(access, 1 << 20, false) >= 0, "a file in memory");
    // small nodes: most arrays are one chunk, and the usual node takes two kilobytes for it
    require(H5Pset_istore_k(creation, 4) >= 0, "a small index of chunks");
    require(H5Pset_obj_track_times(creation, false) >= 0, "a file without times");
    return {H5Fcreate("talus", H5F_ACC_TRUNC, creation, access), H5Fclose};
  }
  Impl() : file(memory_file()) { require(file.valid(), "a file in memory"); }

  [[nodiscard]] Id object(const std::string& path) const {
    Id id(H5Oopen(file, path.empty() ? "/" : path.c_str(), H5P_DEFAULT), H5Oclose);
    require(id.valid(), "opening " + path);
    return id;
  }

  static void put(hid_t object, const std::string& name, hid_t type, hid_t space,
                  const void* value) {
    Id attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    require(attribute.valid() && H5Awrite(attribute, type, value) >= 0, "attribute " + name);
  }
  static void put_text(hid_t object, const std::string& name, const std::string& value) {
    const Id type = text_type(value.size());
    const Id space(H5Screate(H5S_SCALAR), H5Sclose);
    put(object, name, type, space, value.empty() ? "" : value.data());
  }

  // The scale of a dimension, which it begins where no array has done so: a set without values,
  // with the words that netCDF marks such ones with.
  [[nodiscard]] Id scale_of(const std::string& path, std::size_t extent) const {
    if (H5Lexists(file, path.c_str(), H5P_DEFAULT) > 0)
      return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
    const hsize_t n = extent;
    const Id space(H5Screate_simple(1, &n, nullptr), H5Sclose);
    const Id list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_obj_track_times(list, false) >= 0, "a dimension without times");
    Id scale(H5Dcreate2(file, path.c_str(), H5T_IEEE_F32BE, space, H5P_DEFAULT, list, H5P_DEFAULT),
             H5Dclose);
    std::string number = std::to_string(extent);
    number.insert(0, 10 - std::min<std::size_t>(10, number.size()), ' ');
    require(
        H5DSset_scale(
            scale, ("This is a netCDF dimension but not a netCDF variable." + number).c_str()) >= 0,
        "making the dimension " + path);
    return scale;
  }

  void name_dimensions(const std::string& path, hid_t set, const Dimensions& dimensions) const {
    const std::size_t slash = path.rfind('/');
    const std::string group = slash == std::string::npos ? "/" : "/" + path.substr(0, slash + 1);
    for (unsigned d = 0; d < dimensions.size(); ++d) {
      const auto& [name, extent] = dimensions[d];
      const std::string at = name[0] == '/' ? name : group + name;
      if (at == "/" + path) {
        require(H5DSset_scale(set, name.c_str()) >= 0, "making the dimension " + at);
        continue;
      }
      const Id scale = scale_of(at, extent);
      const Id space(H5Dget_space(scale), H5Sclose);
      TALUS_ASSERT(H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(extent));
      require(H5DSattach_scale(set, scale, d) >= 0, "naming a dimension of " + path);
    }
  }

  static constexpr std::size_t smallest_chunk = 1024, chunk_bytes = 65536;

  // Chunks of about 64 KiB along the first dimension; short arrays in one piece without filters.
  static Id creation(const Shape& shape, std::size_t size) {
    Id list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    require(H5Pset_obj_track_times(list, false) >= 0, "an array without times");
    const std::size_t row = std::max<std::size_t>(1, shape[0] == 0 ? 1 : product(shape) / shape[0]);
    if (product(shape) * size < smallest_chunk) return list;
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    chunk[0] = std::clamp<hsize_t>(chunk_bytes / (row * size), 1, shape[0]);
    require(H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data()) >= 0 &&
                H5Pset_shuffle(list) >= 0 && H5Pset_deflate(list, 4) >= 0 &&
                H5Pset_fletcher32(list) >= 0,
            "an array in chunks");
    return list;
  }

  // Calls put(set, extent), which writes the values.
  template <class Put>
  void make(const std::string& path, hid_t stored, const Dimensions& dimensions, std::size_t size,
            const std::string& units, const std::string& long_name, Put&& put) const {
    const Shape shape = shape_of(dimensions);
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    const Id space(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                   H5Sclose);
    const Id list = creation(shape, size);
    const Id set(H5Dcreate2(file, path.c_str(), stored, space, H5P_DEFAULT, list, H5P_DEFAULT),
                 H5Dclose);
    require(set.valid(), "making " + path);
    if (product(shape) > 0) require(put(set, space) >= 0, "writing " + path);
    if (!units.empty()) put_text(set, "units", units);
    put_text(set, "long_name", long_name);
    name_dimensions(path, set, dimensions);
  }

  void write(const std::string& path, hid_t stored, hid_t native, const void* values,
             const Dimensions& dimensions, std::size_t size, const std::string& units,
             const std::string& long_name) const {
    make(path, stored, dimensions, size, units, long_name, [&](hid_t set, hid_t) {
      return H5Dwrite(set, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    });
  }
};

H5Writer::H5Writer() : impl_(std::make_unique<Impl>()) {
  attribute("", "Conventions", std::string("CF-1.10"));
}
H5Writer::~H5Writer() = default;

void H5Writer::group(const std::string& path, const std::string& description) {
  Id creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  require(H5Pset_obj_track_times(creation, false) >= 0, "a group without times");
  Id group(H5Gcreate2(impl_->file, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
  require(group.valid(), "making " + path);
  Impl::put_text(group, "description", description);
}

template <class T>
void H5Writer::array(const std::string& path, std::span<const T> values,
                     const Dimensions& dimensions, const std::string& units,
                     const std::string& long_name) {
  TALUS_ASSERT(product(shape_of(dimensions)) == values.size());
  const hid_t native = native_type<T>();
  impl_->write(path, file_type(native), native, values.data(), dimensions, sizeof(T), units,
               long_name);
}

template void H5Writer::array(const std::string&, std::span<const std::uint8_t>, const Dimensions&,
                              const std::string&, const std::string&);
template void H5Writer::array(const std::string&, std::span<const std::int32_t>, const Dimensions&,
                              const std::string&, const std::string&);
template void H5Writer::array(const std::string&, std::span<const std::int64_t>, const Dimensions&,
                              const std::string&, const std::string&);
template void H5Writer::array(const std::string&, std::span<const float>, const Dimensions&,
                              const std::string&, const std::string&);
template void H5Writer::array(const std::string&, std::span<const double>, const Dimensions&,
                              const std::string&, const std::string&);

template <class T>
void H5Writer::column(const std::string& path, const Dimension& dimension,
                      const std::function<void(std::size_t first, std::span<T> values)>& fill,
                      const std::string& units, const std::string& long_name) {
  const hid_t native = native_type<T>();
  const auto put = [&](hid_t set, hid_t space) {
    std::vector<T> values(std::min(dimension.extent, Impl::chunk_bytes / sizeof(T)));
    herr_t result = 0;
    for (hsize_t first = 0; first < dimension.extent && result >= 0; first += values.size()) {
      const hsize_t n = std::min<hsize_t>(values.size(), dimension.extent - first);
      fill(first, std::span(values.data(), n));
      const Id in_memory(H5Screate_simple(1, &n, nullptr), H5Sclose);
      result = H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &n, nullptr);
      if (result >= 0) result = H5Dwrite(set, native, in_memory, space, H5P_DEFAULT, values.data());
    }
    return result;
  };
  impl_->make(path, file_type(native), {dimension}, sizeof(T), units, long_name, put);
}

template void H5Writer::column(const std::string&, const Dimension&,
                               const std::function<void(std::size_t, std::span<std::int32_t>)>&,
                               const std::string&, const std::string&);
template void H5Writer::column(const std::string&, const Dimension&,
                               const std::function<void(std::size_t, std::span<std::int64_t>)>&,
                               const std::string&, const std::string&);
template void H5Writer::column(const std::string&, const Dimension&,
                               const std::function<void(std::size_t, std::span<float>)>&,
                               const std::string&, const std::string&);
template void H5Writer::column(const std::string&, const Dimension&,
                               const std::function<void(std::size_t, std::span<double>)>&,
                               const std::string&, const std::string&);

void H5Writer::text(const std::string& path, const std::string& value,
                    const std::string& long_name) {
  texts(path, {value}, "/one", long_name);
}

void H5Writer::texts(const std::string& path, const std::vector<std::string>& values,
                     const std::string& dimension, const std::string& long_name) {
  // netCDF reads on to a zero, and takes texts of one byte for letters
  std::size_t length = 2;
  for (const std::string& value : values) length = std::max(length, value.size() + 1);
  std::string bytes;
  for (const std::string& value : values) {
    bytes += value;
    bytes.resize(bytes.size() + length - value.size(), '\0');
  }
  const Id type = text_type(length);
  impl_->write(path, type, type, bytes.data(), {{dimension, values.size()}}, length, "", long_name);
}

void H5Writer::names(const std::string& path, const std::vector<std::string>& values,
                     const std::string& dimension, const std::string& long_name) {
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  const Id type = text_type(H5T_VARIABLE);
  constexpr std::size_t in_one_piece = 0;  // no filter takes texts of any length
  impl_->write(path, type, type, pointers.data(), {{dimension, values.size()}}, in_one_piece, "",
               long_name);
}

void H5Writer::attribute(const std::string& object, const std::string& name,
                         const std::string& value) {
  Impl::put_text(impl_->object(object), name, value);
}

void H5Writer::attribute(const std::string& object, const std::string& name, double value) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  Impl::put(impl_->object(object), name, H5T_IEEE_F64LE, space, &value);
}

void H5Writer::attribute(const std::string& object, const std::string& name, std::int64_t value) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  Impl::put(impl_->object(object), name, H5T_STD_I64LE, space, &value);
}

void H5Writer::attribute(const std::string& object, const std::string& name,
                         std::span<const double> value) {
  const hsize_t n = value.size();
  const Id space(H5Screate_simple(1, &n, nullptr), H5Sclose);
  Impl::put(impl_->object(object), name, H5T_IEEE_F64LE, space, value.data());
}

// From HDF5's own memory: a copy would double the memory for a large file.
void H5Writer::save(const std::string& path) {
  require(H5Fflush(impl_->file, H5F_SCOPE_GLOBAL) >= 0, "completing the file");
  const ssize_t size = H5Fget_file_image(impl_->file, nullptr, 0);
  void* handle = nullptr;
  require(size > 0 && H5Fget_vfd_handle(impl_->file, H5P_DEFAULT, &handle) >= 0, "taking the file");
  const std::span bytes(*static_cast<unsigned char**>(handle), static_cast<std::size_t>(size));
  // The file is marked as open: a mark that H5Fget_file_image() removes from its copy.
  constexpr std::size_t version = 8, open_flags = 20;
  require(bytes[version] < 2, "a file of the first format");
  std::fill_n(bytes.begin() + open_flags, 4, 0);
  const std::string seal = seal_of(bytes.data(), bytes.size());
  write_bytes(path, bytes, {reinterpret_cast<const unsigned char*>(seal.data()), seal.size()});
}

// --- reading -----------------------------------------------------------------------------------

struct H5Reader::Impl {
  std::string path;
  Id file;
  std::size_t most_bytes = 0;  // no array can be longer: deflate packs 1032 to 1 at best

  // Talus writes no links to other files, and no values in them: such a file is meant to make
  // another one be read.
  void check_links() const {
    const auto found = [](hid_t, const char* name, const H5L_info_t* link, void* to) -> herr_t {
      if (link->type == H5L_TYPE_HARD) return 0;
      *static_cast<std::string*>(to) = name;
      return 1;
    };
    std::string link;
    if (H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, found, &link) > 0)
      fail(link, "is a link, to another place or file");
  }

  explicit Impl(const std::string& name) : path(name), file(open(name)) {
    if (!file.valid())
      throw InputError({path}, "is not an HDF5 file that Talus wrote, or it is damaged",
                       "make it again with the tool that wrote it");
    std::error_code error;
    check_links();
    most_bytes = 65536 + 1100 * static_cast<std::size_t>(std::filesystem::file_size(path, error));
  }

  static Id open(const std::string& name) {
    silence();
    if (!std::filesystem::exists(name)) throw InputError({name}, "there is no such file");
    if (!is_sealed(name)) return {H5I_INVALID_HID, H5Fclose};
    const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    // an array is read once: a large table of its chunks costs more than it gives
    H5Pset_cache(access, 0, 13, 1 << 20, 1);
    // Files are whole when they get their names, so no lock is needed; some servers refuse one.
    H5Pset_file_locking(access, false, true);
    return {H5Fopen(name.c_str(), H5F_ACC_RDONLY, access), H5Fclose};
  }

  [[noreturn]] void fail(const std::string& object, const std::string& finding) const {
    throw InputError({path, 0, object.empty() ? "root" : object}, finding,
                     "the file was made by another program or version, or is damaged");
  }

  [[nodiscard]] Id set(const std::string& name) const {
    Id id(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!id.valid()) fail(name, "is missing");
    const Id list(H5Dget_create_plist(id), H5Pclose);
    if (H5Pget_external_count(list) > 0 || H5Pget_layout(list) == H5D_VIRTUAL)
      fail(name, "has its values in another file");
    return id;
  }

  [[nodiscard]] Shape shape_of(const std::string& name, hid_t id) const {
    const Id space(H5Dget_space(id), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 4) fail(name, "has " + std::to_string(rank) + " dimensions");
    std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
    if (H5Sget_simple_extent_dims(space, extent.data(), nullptr) != rank)
      fail(name, "has no extent");
    return {extent.begin(), extent.end()};
  }

  // Before the array is taken: a packed one may be a thousand times as long as its file.
  void ask_for_memory(const std::string& name, std::size_t n, std::size_t size) const {
    require_memory(static_cast<double>(n) * static_cast<double>(size), {path, 0, name},
                   std::to_string(n) + " values", "evaluate fewer runs at a time");
  }

  // Number of columns, checked; the values fit into `most_bytes`.
  std::size_t check(const std::string& name, const Shape& shape, std::size_t columns,
                    std::size_t size) const {
    std::size_t n = size, row = 1;
    for (std::size_t d = 0; d < shape.size(); ++d) {
      if (shape[d] != 0 && n > most_bytes / shape[d]) fail(name, "claims more than the file holds");
      n *= shape[d];
      if (d > 0) row *= shape[d];
    }
    if (columns != 0 && row != columns)
      fail(name, "has " + std::to_string(row) + " columns, expected " + std::to_string(columns));
    return row;
  }

  void check_class(const std::string& name, hid_t id, bool integer) const {
    const Id type(H5Dget_type(id), H5Tclose);
    if (H5Tget_class(type) != (integer ? H5T_INTEGER : H5T_FLOAT))
      fail(name, integer ? "does not hold integers" : "does not hold numbers");
  }

  // An array that is stored in one piece is read without further checks by the library: its piece
  // must be there.
  void check_storage(const std::string& name, hid_t id, const Shape& shape) const {
    const Id type(H5Dget_type(id), H5Tclose);
    std::size_t bytes = H5Tget_size(type);
    for (const std::size_t extent : shape) bytes *= extent;
    if (H5Dget_storage_size(id) == bytes) return;
    const Id list(H5Dget_create_plist(id), H5Pclose);
    if (H5Pget_layout(list) != H5D_CHUNKED) fail(name, "is not as long as it claims");
  }

  [[nodiscard]] Id attribute(const std::string& object, const std::string& name) const {
    const Id owner(H5Oopen(file, object.empty() ? "/" : object.c_str(), H5P_DEFAULT), H5Oclose);
    if (!owner.valid()) fail(object, "is missing");
    Id id(H5Aopen(owner, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!id.valid()) fail(object, "has no attribute " + name);
    return id;
  }

  // Values of a numeric attribute with at most 64 of them.
  template <class T>
  [[nodiscard]] std::vector<T> numbers(const std::string& object, const std::string& name) const {
    const Id id = attribute(object, name);
    const Id type(H5Aget_type(id), H5Tclose), space(H5Aget_space(id), H5Sclose);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    const H5T_class_t wanted = std::is_integral_v<T> ? H5T_INTEGER : H5T_FLOAT;
    if (H5Tget_class(type) != wanted || n < 1 || n > 64)
      fail(object, "attribute " + name + " is of another type or length");
    std::vector<T> values(static_cast<std::size_t>(n));
    if (H5Aread(id, native_type<T>(), values.data()) < 0)
      fail(object, "attribute " + name + " cannot be read");
    return values;
  }

  [[nodiscard]] std::vector<std::string> names(const std::string& path_in_file, hid_t set,
                                               hid_t type, const Shape& shape) const {
    check(path_in_file, shape, 1, sizeof(char*));
    std::vector<char*> pointers(shape[0], nullptr);
    std::vector<std::string> values;
    if (pointers.empty()) return values;
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) < 0)
      fail(path_in_file, "cannot be read: its content is damaged");
    for (const char* text : pointers) values.emplace_back(text == nullptr ? "" : text);
    const Id space(H5Dget_space(set), H5Sclose);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
    return values;
  }

  // Length of one entry of a text type of fixed length.
  [[nodiscard]] std::size_t text_length(const std::string& name, hid_t type) const {
    const std::size_t length = H5Tget_size(type);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || length == 0 ||
        length > most_bytes)
      fail(name, "is not text of a fixed length");
    return length;
  }
};

namespace {

std::string without_padding(const char* bytes, std::size_t length) {
  return {bytes, strnlen(bytes, length)};
}

}  // namespace

H5Reader::H5Reader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
H5Reader::~H5Reader() = default;

bool H5Reader::has(const std::string& path) const {
  const std::size_t slash = path.rfind('/');  // H5Lexists fails where a parent is missing
  if (slash != std::string::npos && !has(path.substr(0, slash))) return false;
  return H5Lexists(impl_->file, path.c_str(), H5P_DEFAULT) > 0;
}

Shape H5Reader::shape(const std::string& path) const {
  return impl_->shape_of(path, impl_->set(path));
}

template <class T>
std::vector<T> H5Reader::array(const std::string& path, std::size_t columns) const {
  const Id set = impl_->set(path);
  impl_->check_class(path, set, std::is_integral_v<T>);
  const Shape shape = impl_->shape_of(path, set);
  const std::size_t n = shape[0] * impl_->check(path, shape, columns, sizeof(T));
  impl_->ask_for_memory(path, n, sizeof(T));
  std::vector<T> values(n);
  impl_->check_storage(path, set, shape);
  if (!values.empty() &&
      H5Dread(set, native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    impl_->fail(path, "cannot be read: its content is damaged");
  return values;
}

template <class T>
std::vector<T> H5Reader::rows(const std::string& path, std::size_t columns, std::size_t first,
                              std::size_t n) const {
  const Id set = impl_->set(path);
  impl_->check_class(path, set, std::is_integral_v<T>);
  const Shape shape = impl_->shape_of(path, set);
  const std::size_t row = impl_->check(path, shape, columns, sizeof(T));
  impl_->check_storage(path, set, shape);
  if (first > shape[0] || n > shape[0] - first) impl_->fail(path, "has fewer rows than asked for");
  impl_->ask_for_memory(path, n * row, sizeof(T));
  std::vector<T> values(n * row);
  if (values.empty()) return values;
  std::vector<hsize_t> start(shape.size(), 0), count(shape.begin(), shape.end());
  start[0] = first;
  count[0] = n;
  const Id in_file(H5Dget_space(set), H5Sclose);
  const Id in_memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                     H5Sclose);
  if (H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) <
          0 ||
      H5Dread(set, native_type<T>(), in_memory, in_file, H5P_DEFAULT, values.data()) < 0)
    impl_->fail(path, "cannot be read: its content is damaged");
  return values;
}

template std::vector<std::uint8_t> H5Reader::array(const std::string&, std::size_t) const;
template std::vector<std::int32_t> H5Reader::array(const std::string&, std::size_t) const;
template std::vector<std::int64_t> H5Reader::array(const std::string&, std::size_t) const;
template std::vector<float> H5Reader::array(const std::string&, std::size_t) const;
template std::vector<double> H5Reader::array(const std::string&, std::size_t) const;
template std::vector<std::int32_t> H5Reader::rows(const std::string&, std::size_t, std::size_t,
                                                  std::size_t) const;
template std::vector<std::int64_t> H5Reader::rows(const std::string&, std::size_t, std::size_t,
                                                  std::size_t) const;
template std::vector<float> H5Reader::rows(const std::string&, std::size_t, std::size_t,
                                           std::size_t) const;
template std::vector<double> H5Reader::rows(const std::string&, std::size_t, std::size_t,
                                            std::size_t) const;

std::string H5Reader::text(const std::string& path) const {
  const std::vector<std::string> all = texts(path);
  if (all.size() != 1) impl_->fail(path, "is not one text");
  return all[0];
}

std::vector<std::string> H5Reader::texts(const std::string& path) const {
  const Id set = impl_->set(path);
  const Id type(H5Dget_type(set), H5Tclose);
  const Shape shape = impl_->shape_of(path, set);
  if (H5Tis_variable_str(type) > 0) return impl_->names(path, set, type, shape);
  const std::size_t length = impl_->text_length(path, type);
  impl_->check(path, shape, 1, length);
  impl_->check_storage(path, set, shape);
  impl_->ask_for_memory(path, shape[0] * length, 1);
  std::vector<char> bytes(shape[0] * length);
  if (!bytes.empty() && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
    impl_->fail(path, "cannot be read: its content is damaged");
  std::vector<std::string> values;
  for (std::size_t i = 0; i < shape[0]; ++i)
    values.push_back(without_padding(bytes.data() + i * length, length));
  return values;
}

std::string H5Reader::attribute_text(const std::string& object, const std::string& name) const {
  const Id id = impl_->attribute(object, name);
  const Id type(H5Aget_type(id), H5Tclose), space(H5Aget_space(id), H5Sclose);
  const std::size_t length = impl_->text_length(object, type);
  if (H5Sget_simple_extent_npoints(space) != 1)
    impl_->fail(object, "attribute " + name + " is not one text");
  std::vector<char> bytes(length);
  if (H5Aread(id, type, bytes.data()) < 0)
    impl_->fail(object, "attribute " + name + " cannot be read");
  return without_padding(bytes.data(), length);
}

double H5Reader::attribute_number(const std::string& object, const std::string& name) const {
  return impl_->numbers<double>(object, name)[0];
}

std::int64_t H5Reader::attribute_integer(const std::string& object, const std::string& name) const {
  return impl_->numbers<std::int64_t>(object, name)[0];
}

std::vector<double> H5Reader::attribute_numbers(const std::string& object,
                                                const std::string& name) const {
  return impl_->numbers<double>(object, name);
}

}  // namespace talus
