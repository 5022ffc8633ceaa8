// libcore/io/h5_hdf5.hpp: public
// HDF5 as Talus uses it: arrays with named dimensions, a unit and a name in words; attributes. The
// files open in netCDF-4 and xarray as well: dimensions are dimension scales, as these expect them.
//
// Writing builds the whole file in memory, without time stamps, so that equal content gives equal
// bytes and no half-written HDF5 file ever reaches the disk. Reading checks type, rank and extent
// of every array before it takes memory for it. A SHA-256 of the HDF5 bytes is appended to the
// file; a file without, or with another, is not opened.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace talus {

using Shape = std::vector<std::size_t>;

/// The arrays of a group that name a dimension have the same extent along it. With a slash in
/// front the name is the root's, and of all groups. Its coordinates are the array of that name.
struct Dimension {
  std::string name;
  std::size_t extent;
};
using Dimensions = std::vector<Dimension>;

/// Element types: std::uint8_t, std::int32_t, std::int64_t, float, double.
class H5Writer {
 public:
  H5Writer();
  ~H5Writer();
  H5Writer(const H5Writer&) = delete;
  H5Writer& operator=(const H5Writer&) = delete;

  /// `path` from the root without a leading slash; its parent must exist.
  void group(const std::string& path, const std::string& description);
  /// Row by row. `units` "1" for numbers without. Stored in chunks, shuffled and deflated when it
  /// is longer than a kilobyte.
  template <class T>
  void array(const std::string& path, std::span<const T> values, const Dimensions& dimensions,
             const std::string& units, const std::string& long_name);
  /// The same of one dimension, a piece at a time: fill(first, values) sets those from `first` on.
  template <class T>
  void column(const std::string& path, const Dimension& dimension,
              const std::function<void(std::size_t first, std::span<T> values)>& fill,
              const std::string& units, const std::string& long_name);
  void text(const std::string& path, const std::string& value, const std::string& long_name);
  /// Of fixed length, packed. netCDF 4.9 reads only a single one: for long texts of many runs.
  void texts(const std::string& path, const std::vector<std::string>& values,
             const std::string& dimension, const std::string& long_name);
  /// Each of its own length, not packed: for short ones.
  void names(const std::string& path, const std::vector<std::string>& values,
             const std::string& dimension, const std::string& long_name);

  /// `object` "" is the root.
  void attribute(const std::string& object, const std::string& name, const std::string& value);
  void attribute(const std::string& object, const std::string& name, double value);
  void attribute(const std::string& object, const std::string& name, std::int64_t value);
  void attribute(const std::string& object, const std::string& name, std::span<const double> value);

  /// Writes the file by write_bytes(); nothing can be added afterwards.
  void save(const std::string& path);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Opens a file for reading. Every function throws InputError naming file and object when the
/// object is missing, of another type or shape, or cannot be read.
class H5Reader {
 public:
  explicit H5Reader(const std::string& path);
  ~H5Reader();
  H5Reader(const H5Reader&) = delete;
  H5Reader& operator=(const H5Reader&) = delete;

  [[nodiscard]] bool has(const std::string& path) const;
  [[nodiscard]] Shape shape(const std::string& path) const;
  /// All values; `columns` is the product of the extents after the first, 0 for any.
  template <class T>
  [[nodiscard]] std::vector<T> array(const std::string& path, std::size_t columns) const;
  /// Rows first..first + n - 1 of the first dimension.
  template <class T>
  [[nodiscard]] std::vector<T> rows(const std::string& path, std::size_t columns, std::size_t first,
                                    std::size_t n) const;
  [[nodiscard]] std::string text(const std::string& path) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& path) const;

  [[nodiscard]] std::string attribute_text(const std::string& object,
                                           const std::string& name) const;
  [[nodiscard]] double attribute_number(const std::string& object, const std::string& name) const;
  [[nodiscard]] std::int64_t attribute_integer(const std::string& object,
                                               const std::string& name) const;
  [[nodiscard]] std::vector<double> attribute_numbers(const std::string& object,
                                                      const std::string& name) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace talus
