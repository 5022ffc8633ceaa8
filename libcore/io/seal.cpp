// Computes and checks the seal of a file: the SHA-256 of its bytes.
#include "io/seal.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <vector>

#include "base/sha256.hpp"

namespace talus {
namespace {

const std::string seal_mark = "talus-sha256 ";
constexpr std::size_t seal_length = 13 + 64;

}  // namespace

std::string seal_of(const void* bytes, std::size_t n_bytes) {
  Sha256 digest;
  digest.add(bytes, n_bytes);
  return seal_mark + digest.hex();
}

bool is_sealed(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!in || error || size < seal_length) return false;
  Sha256 digest;
  std::vector<char> piece(std::min<std::uintmax_t>(size, 1 << 20));
  for (std::uintmax_t left = size - seal_length; left > 0;) {
    const auto n = static_cast<std::size_t>(std::min<std::uintmax_t>(left, piece.size()));
    if (!in.read(piece.data(), static_cast<std::streamsize>(n))) return false;
    digest.add(piece.data(), n);
    left -= n;
  }
  std::string seal(seal_length, ' ');
  return in.read(seal.data(), seal_length) && seal == seal_mark + digest.hex();
}

}  // namespace talus
