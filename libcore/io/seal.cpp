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

namespace {

// Digest of the first bytes of a file; empty when they cannot be read.
std::string digest_of(std::ifstream& in, std::uintmax_t n_bytes) {
  Sha256 digest;
  std::vector<char> piece(std::min<std::uintmax_t>(n_bytes, 1 << 20));
  for (std::uintmax_t left = n_bytes; left > 0;) {
    const auto n = static_cast<std::size_t>(std::min<std::uintmax_t>(left, piece.size()));
    if (!in.read(piece.data(), static_cast<std::streamsize>(n))) return {};
    digest.add(piece.data(), n);
    left -= n;
  }
  return digest.hex();
}

}  // namespace

bool seal_file(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  const std::string digest = error ? std::string() : digest_of(in, size);
  std::ofstream out(path, std::ios::binary | std::ios::app);
  return !digest.empty() && (out << seal_mark << digest).flush().good();
}

bool is_sealed(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!in || error || size < seal_length) return false;
  std::string seal(seal_length, ' ');
  in.seekg(static_cast<std::streamoff>(size - seal_length));
  if (!in.read(seal.data(), seal_length) || !seal.starts_with(seal_mark)) return false;
  in.seekg(0);
  return seal == seal_mark + digest_of(in, size - seal_length);
}

}  // namespace talus
