// tests/fuzz/fuzz_ply.cpp
// Mesh files: PLY, up to the bodies that blocks are made of.
#include "fuzz.hpp"
#include "io/mesh.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses([&] {
    static_cast<void>(talus::bodies_of(talus::parse_ply(talus::text_of(data, size), "fuzz.ply")));
  });
}
