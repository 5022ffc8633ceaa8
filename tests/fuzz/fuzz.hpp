// tests/fuzz/fuzz.hpp
// Common code of the fuzz targets. The claim of each: whatever the bytes, the parser gives a value
// or throws InputError; it never crashes, hangs, or throws anything else. tests/fuzz/run.sh
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "base/error.hpp"

namespace talus {

inline long n_accepted = 0;  ///< inputs that were not refused

/// Calls `parse`; input may be refused. Any other exception ends the program.
template <class Parse>
int accepts_or_refuses(Parse&& parse) {
  try {
    parse();
    ++n_accepted;
  } catch (const InputError&) {
  }
  return 0;
}

/// A file for parsers that take a name; one for the whole program, written anew for every input.
class InputFile {
 public:
  InputFile(const std::uint8_t* data, std::size_t size) {
    std::ofstream file(path(), std::ios::binary);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    if (!file.flush()) throw std::runtime_error("cannot write " + path());
  }
  ~InputFile() { std::remove(path().c_str()); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  [[nodiscard]] static std::string path() {
    return (std::filesystem::temp_directory_path() / ("talus_fuzz_" + std::to_string(getpid())))
        .string();
  }
};

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace talus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
