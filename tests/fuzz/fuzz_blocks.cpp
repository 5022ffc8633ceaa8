// tests/fuzz/fuzz_blocks.cpp
// Block sets (HDF5).
#include "fuzz.hpp"
#include "io/blocks_hdf5.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses([&] {
    const talus::InputFile file(data, size);
    static_cast<void>(talus::read_blocks(file.path()));
  });
}
