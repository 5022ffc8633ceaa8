// tests/fuzz/fuzz_sealed.cpp
// Sealed files whose seal is right but whose content is not: block sets, runs and parts. The input
// is a list of edits, each of eight bytes, to a sound file; the edited file is sealed anew, so that
// the readers see it. With TALUS_FUZZ_KEEP=FOLDER, files that are accepted are kept there.
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "fuzz.hpp"
#include "io/blocks_hdf5.hpp"
#include "io/seal.hpp"
#include "record/part_file.hpp"
#include "record/run_file.hpp"
#include "store/checkpoint.hpp"

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array sound_files = {"corpus/blocks/two.h5", "corpus/run/done.h5",
                                    "corpus/run/running.h5", "sealed/part.h5"};
constexpr std::size_t part_number = 3;

Bytes read_sound_file(const char* name) {
  std::ifstream file(std::string(TALUS_FUZZ_FOLDER) + "/" + name, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (bytes.empty()) throw std::runtime_error(std::string("cannot read ") + name);
  return bytes;
}

const Bytes& sound_file(std::size_t number) {
  static const auto all = [] {
    std::array<Bytes, sound_files.size()> read;
    std::transform(sound_files.begin(), sound_files.end(), read.begin(), read_sound_file);
    return read;
  }();
  return all[number];
}

// One edit: an array or attribute, the kind of change, its place, and its value.
struct Edit {
  std::uint8_t object, kind, value, type;
  std::uint16_t at, extent;
};
static_assert(sizeof(Edit) == 8);

// Numbers at the borders of the ranges of indices, counts and measures.
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr std::array numbers = {
    0.0,    -0.0,  1.0,          -1.0, 2.0, 3.0,  7.0,    255.0, 256.0, 65535.0, 2147483647.0,
    -2.0e9, 4.0e9, 1.0e18,       1e-9, 0.5, -0.5, 1e-300, 1e9,   1e30,  1e300,   -1e300,
    inf,    -inf,  not_a_number, 1e-5, 1e5, 4.0,  5.0,    6.0,   8.0,   100.0};

double number_of(std::uint8_t value) { return numbers[value % numbers.size()]; }

// As an element of a type; integers saturate.
template <class T>
void put(T* to, double value) {
  if constexpr (std::is_floating_point_v<T>) {
    *to = static_cast<T>(value);
  } else {
    const double low = static_cast<double>(std::numeric_limits<T>::min());
    const double high = static_cast<double>(std::numeric_limits<T>::max());
    if (std::isnan(value))
      *to = 0;
    else if (value <= low)
      *to = std::numeric_limits<T>::min();
    else if (value >= high)
      *to = std::numeric_limits<T>::max();
    else
      *to = static_cast<T>(value);
  }
}

void put_element(std::span<std::uint8_t> bytes, hid_t type, double value) {
  const bool is_integer = H5Tget_class(type) == H5T_INTEGER;
  void* const to = bytes.data();
  switch (bytes.size()) {
    case 1:
      return put(static_cast<std::uint8_t*>(to), value);
    case 4:
      return is_integer ? put(static_cast<std::int32_t*>(to), value)
                        : put(static_cast<float*>(to), value);
    case 8:
      return is_integer ? put(static_cast<std::int64_t*>(to), value)
                        : put(static_cast<double*>(to), value);
    default:  // text
      for (std::uint8_t& byte : bytes) put(&byte, value);
  }
}

struct Object {
  std::string set, attribute;  // of the set, or "" for the set itself
};

struct Edited {
  hid_t file = -1;
  std::vector<Object> objects;

  explicit Edited(const Bytes& image) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(access, 1 << 16, false);
    Bytes copy = image;
    H5Pset_file_image(access, copy.data(), copy.size());
    file = H5Fopen("edited", H5F_ACC_RDWR, access);
    H5Pclose(access);
    if (file < 0) throw std::runtime_error("a sound file does not open");
    find_objects();
  }
  ~Edited() { H5Fclose(file); }
  Edited(const Edited&) = delete;
  Edited& operator=(const Edited&) = delete;

  void find_objects() {
    static const std::set<std::string> not_read = {
        "units", "long_name", "description", "CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST"};
    const auto visit = [](hid_t top, const char* name, const auto* info, void* to) -> herr_t {
      auto& found = *static_cast<std::vector<Object>*>(to);
      if (info->type == H5O_TYPE_DATASET) found.push_back({name, ""});
      const hid_t object = H5Oopen(top, name, H5P_DEFAULT);
      for (int a = 0; a < H5Aget_num_attrs(object); ++a) {
        const hid_t attribute = H5Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC,
                                               static_cast<hsize_t>(a), H5P_DEFAULT, H5P_DEFAULT);
        std::array<char, 256> text{};
        H5Aget_name(attribute, text.size(), text.data());
        H5Aclose(attribute);
        const std::string word = text.data();
        if (!not_read.contains(word)) found.push_back({name, word});
      }
      H5Oclose(object);
      return 0;
    };
#if H5_VERSION_GE(1, 12, 0)
    H5Ovisit3(file, H5_INDEX_NAME, H5_ITER_INC, visit, &objects, H5O_INFO_BASIC);
#else
    H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, visit, &objects);
#endif
  }

  void apply(const Edit& edit) {
    const Object& object = objects[edit.object % objects.size()];
    object.attribute.empty() ? change_set(object.set, edit) : change_attribute(object, edit);
  }

  static void change_values(Bytes& bytes, std::size_t size, hid_t type, const Edit& edit) {
    const std::size_t n = bytes.size() / size;
    if (n == 0) return;
    const auto element = [&](std::size_t i) {
      return std::span(bytes).subspan(i % n * size, size);
    };
    const double value = number_of(edit.value);
    switch (edit.kind % 8) {
      case 0:
        return put_element(element(edit.at), type, value);
      case 1:
        for (std::size_t i = 0; i < n; ++i) put_element(element(i), type, value);
        return;
      case 2: {
        const auto a = element(edit.at), b = element(edit.extent);
        if (a.data() != b.data()) std::swap_ranges(a.begin(), a.end(), b.begin());
        return;
      }
      case 3: {  // as the neighbour
        const auto from = element(edit.at), to = element(std::size_t{edit.at} + 1);
        std::copy(from.begin(), from.end(), to.begin());
        return;
      }
      default:  // its own bits
        element(edit.at)[edit.extent % size] ^= static_cast<std::uint8_t>(1u << (edit.value % 8));
    }
  }

  void change_set(const std::string& name, const Edit& edit) {
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    if (set < 0) return;  // an edit before has removed it
    const hid_t type = H5Dget_type(set), space = H5Dget_space(set);
    const std::size_t size = H5Tget_size(type);
    std::vector<hsize_t> extent(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    Bytes bytes(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) * size);
    if (!bytes.empty()) H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    if (edit.kind % 16 < 8) {
      change_values(bytes, size, type, edit);
      if (!bytes.empty()) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    } else {
      H5Ldelete(file, name.c_str(), H5P_DEFAULT);
      if (edit.kind % 16 < 14) make_again(name, type, bytes, extent, edit);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
  }

  // With other extents, another rank or another type.
  void make_again(const std::string& name, hid_t type, Bytes bytes, std::vector<hsize_t> extent,
                  const Edit& edit) const {
    if (extent.empty()) return;
    const std::array types = {H5T_STD_U8LE,   H5T_STD_I32LE,  H5T_STD_I64LE,
                              H5T_IEEE_F32LE, H5T_IEEE_F64LE, H5T_STD_I64BE};
    hid_t stored = type;
    switch (edit.kind % 16) {
      case 8:
      case 9:  // a few rows more or less
        extent[0] = extent[0] + 2 < edit.extent % 5u ? 0 : extent[0] + 2 - edit.extent % 5u;
        break;
      case 10:
        extent[edit.at % extent.size()] = edit.extent;
        break;
      case 11:
        extent.push_back(1 + edit.extent % 3u);
        break;
      case 12:
        extent.pop_back();
        break;
      default:
        stored = types[edit.type % types.size()];
    }
    std::size_t n = 1;
    for (const hsize_t e : extent) n *= static_cast<std::size_t>(e);
    if (n > 1000000) return;
    bytes.resize(n * H5Tget_size(type));
    const hid_t space = H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr);
    const hid_t set =
        H5Dcreate2(file, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (set >= 0 && n > 0) H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data());
    if (set >= 0) H5Dclose(set);
    H5Sclose(space);
  }

  void change_attribute(const Object& object, const Edit& edit) const {
    const hid_t owner = H5Oopen(file, object.set.c_str(), H5P_DEFAULT);
    if (owner < 0) return;
    const hid_t attribute = H5Aopen(owner, object.attribute.c_str(), H5P_DEFAULT);
    if (attribute >= 0) {
      const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
      const std::size_t size = H5Tget_size(type);
      Bytes bytes(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)) * size);
      H5Aread(attribute, type, bytes.data());
      change_values(bytes, size, type, edit);
      if (edit.kind % 16 < 14) H5Awrite(attribute, type, bytes.data());
      H5Sclose(space);
      H5Tclose(type);
      H5Aclose(attribute);
      if (edit.kind % 16 >= 14) H5Adelete(owner, object.attribute.c_str());
    }
    H5Oclose(owner);
  }

  [[nodiscard]] Bytes sealed() const {
    H5Fflush(file, H5F_SCOPE_GLOBAL);
    Bytes bytes(static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0)));
    H5Fget_file_image(file, bytes.data(), bytes.size());
    const std::string seal = talus::seal_of(bytes.data(), bytes.size());
    bytes.insert(bytes.end(), seal.begin(), seal.end());
    return bytes;
  }
};

// All that the tools read of a file of this kind.
void read_all(std::size_t number, const std::string& path) {
  if (number == 0) {
    static_cast<void>(talus::read_blocks(path));
  } else if (number == part_number) {
    const talus::PartFile file(path);
    static_cast<void>(file.rows(0, file.cell.size()));
    for (int run = 0; run < n_runs(file.part); ++run)
      static_cast<void>(talus::run_of(file.part, run));
  } else {
    const talus::RunFile run = talus::read_run_file(path);
    if (!run.checkpoint.empty())
      static_cast<void>(talus::unpack(run.checkpoint, talus::n_blocks(run),
                                      run.grid.n_rows * run.grid.n_cols, "fuzz.h5"));
  }
}

void keep_accepted(std::size_t number, const Bytes& bytes) {
  const char* const folder = std::getenv("TALUS_FUZZ_KEEP");
  if (folder == nullptr) return;
  const std::string kind = number == 0 ? "blocks" : number == part_number ? "part" : "run";
  std::ofstream(
      std::filesystem::path(folder) / (kind + "_" + std::to_string(talus::n_accepted) + ".h5"),
      std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t most_edits = 8;
  if (size < 1 + sizeof(Edit)) return 0;
  const std::size_t number = data[0] % sound_files.size();
  Edited edited(sound_file(number));
  const std::size_t n = std::min(most_edits, (size - 1) / sizeof(Edit));
  for (std::size_t e = 0; e < n; ++e) {
    Edit edit;
    std::memcpy(&edit, data + 1 + e * sizeof(Edit), sizeof(Edit));
    edited.apply(edit);
  }
  const Bytes bytes = edited.sealed();
  return talus::accepts_or_refuses([&] {
    const talus::InputFile file(bytes.data(), bytes.size());
    read_all(number, talus::InputFile::path());
    keep_accepted(number, bytes);
  });
}
