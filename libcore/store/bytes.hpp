// libcore/store/bytes.hpp
// Plain values as bytes and back, for checkpoints: exact, in the machine's own order of bytes.
//
// A struct is taken apart by one function template fields(archive, value) that calls archive(...)
// on each of its fields; writing and reading share it, and no padding is stored.
#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/error.hpp"
#include "motion/pose.hpp"

namespace talus {

/// Appends its arguments.
struct ByteWriter {
  static constexpr bool is_reading = false;
  std::vector<std::uint8_t> bytes;

  void raw(const void* begin, std::size_t n) {
    const auto* first = static_cast<const std::uint8_t*>(begin);
    bytes.insert(bytes.end(), first, first + n);
  }
  void length(std::size_t& n) {
    const std::uint64_t stored = n;
    raw(&stored, sizeof stored);
  }
};

/// Takes from the front, in the order of writing. Throws InputError when too few bytes are left.
struct ByteReader {
  static constexpr bool is_reading = true;
  std::span<const std::uint8_t> bytes;
  std::string file;  ///< path as messages name it

  void raw(void* begin, std::size_t n) {
    need(n);
    std::memcpy(begin, bytes.data(), n);
    bytes = bytes.subspan(n);
  }
  void length(std::size_t& n) {
    std::uint64_t stored = 0;
    raw(&stored, sizeof stored);
    need(stored);  // an entry takes a byte or more: no memory for a length that cannot be
    n = static_cast<std::size_t>(stored);
  }
  void need(std::uint64_t n) const {
    if (n > bytes.size())
      throw InputError({file, 0, "checkpoint"}, "ends too early",
                       "it was written by another version, or is damaged: start the run again");
  }
};

template <class Archive>
struct Fields {
  Archive& archive;

  template <class... Values>
  void operator()(Values&... values) {
    (one(values), ...);
  }

 private:
  template <class T>
  void one(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
      archive.raw(&value, sizeof value);
    else
      fields(*this, value);
  }
};

template <class Archive, int Rows>
void fields(Fields<Archive>& archive, Eigen::Matrix<double, Rows, 1>& value) {
  for (int i = 0; i < Rows; ++i) archive(value[i]);
}
template <class Archive>
void fields(Fields<Archive>& archive, Quat& value) {
  archive(value.x(), value.y(), value.z(), value.w());
}
template <class Archive, class List>
void list_fields(Fields<Archive>& archive, List& values) {
  std::size_t n = values.size();
  archive.archive.length(n);
  if constexpr (Archive::is_reading) values.resize(n);
  for (auto& value : values) archive(value);
}
template <class Archive, class T>
void fields(Fields<Archive>& archive, std::vector<T>& values) {
  list_fields(archive, values);
}
template <class Archive, class T>
void fields(Fields<Archive>& archive, std::deque<T>& values) {
  list_fields(archive, values);
}

}  // namespace talus
