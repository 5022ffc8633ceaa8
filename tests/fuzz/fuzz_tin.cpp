// tests/fuzz/fuzz_tin.cpp
// TINs as talus-trn reads them.
#include "fuzz.hpp"
#include "io/tin_ply.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses([&] {
    static_cast<void>(talus::parse_tin({reinterpret_cast<const char*>(data), size}, "fuzz.ply"));
  });
}
