// sha256.hpp, by libcrypto
#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <new>
#include <vector>

#include "base/error.hpp"
#include "base/sha256.hpp"

namespace talus {

void Sha256::Free::operator()(EVP_MD_CTX* state) const { EVP_MD_CTX_free(state); }

Sha256::Sha256() : state_(EVP_MD_CTX_new()) {
  // A tool depends on its inputs and not on settings of the machine.
  static const int ready = OPENSSL_init_crypto(OPENSSL_INIT_NO_LOAD_CONFIG, nullptr);
  static_cast<void>(ready);
  if (!state_ || EVP_DigestInit_ex(state_.get(), EVP_sha256(), nullptr) != 1)
    throw std::bad_alloc();  // the only reason to fail
}

void Sha256::add(const void* bytes, std::size_t n_bytes) {
  EVP_DigestUpdate(state_.get(), bytes, n_bytes);
}

std::string Sha256::hex() {
  std::array<unsigned char, 32> digest{};
  EVP_DigestFinal_ex(state_.get(), digest.data(), nullptr);
  std::string out;
  for (const unsigned char byte : digest)
    for (const int half : {byte >> 4, byte & 15}) out += "0123456789abcdef"[half];
  return out;
}

std::string sha256_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError({path}, "cannot be read");
  Sha256 hash;
  std::vector<char> buffer(1 << 20);
  while (file) {
    file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add(buffer.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) throw InputError({path}, "reading failed before its end");
  return hash.hex();
}

}  // namespace talus
