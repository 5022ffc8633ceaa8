// tests/fuzz/fuzz_motion.cpp
// Records of the ground's acceleration.
#include "fuzz.hpp"
#include "site/base_motion.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses([&] {
    const talus::InputFile file(data, size);
    static_cast<void>(talus::read_acceleration_csv(file.path()));
  });
}
