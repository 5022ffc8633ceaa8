// libcore/base/sha256.hpp: public
// SHA-256 of bytes and files (FIPS 180-4): what ties an output to its inputs. Processors with the
// SHA extensions are found at run time; the digest is the same with and without.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace talus {

/// Feed bytes with add(), read the digest once with hex().
class Sha256 {
 public:
  /// Without the processor's extensions the same digest takes six times as long.
  explicit Sha256(bool use_extensions = true) : use_extensions_(use_extensions) {}
  void add(const void* bytes, std::size_t n_bytes);
  [[nodiscard]] std::string hex();  ///< 64 lower-case digits; the object is spent afterwards

 private:
  void compress(const unsigned char* blocks, std::size_t n_blocks);
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> buffer_{};
  std::uint64_t n_bytes_ = 0;
  bool use_extensions_;
};

/// Digest of a file's content. Throws InputError when it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::string& path);

}  // namespace talus
