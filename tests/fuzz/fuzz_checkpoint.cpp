// tests/fuzz/fuzz_checkpoint.cpp
// Checkpoints whose digest is right but whose content is not.
#include "base/sha256.hpp"
#include "fuzz.hpp"
#include "store/checkpoint.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses([&] {
    std::vector<std::uint8_t> bytes(data, data + size);
    talus::Sha256 hash;
    hash.add(data, size);
    const std::string digest = hash.hex();
    bytes.insert(bytes.end(), digest.begin(), digest.end());
    constexpr int n_blocks = 2, n_cells = 1 << 20;  // of the corpus, or more
    static_cast<void>(talus::unpack(bytes, n_blocks, n_cells, "fuzz.h5"));
  });
}
