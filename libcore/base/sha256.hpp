// libcore/base/sha256.hpp: public
// SHA-256 of bytes and files (FIPS 180-4), by libcrypto: it ties an output to its inputs.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

struct evp_md_ctx_st;

namespace talus {

/// Feed bytes with add(), read the digest once with hex().
class Sha256 {
 public:
  Sha256();
  void add(const void* bytes, std::size_t n_bytes);
  [[nodiscard]] std::string hex();  ///< 64 lower-case digits; the object is spent afterwards

 private:
  struct Free {
    void operator()(evp_md_ctx_st* state) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> state_;
};

/// Digest of a file's content. Throws InputError when it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::string& path);

}  // namespace talus
