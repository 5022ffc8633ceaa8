// tests/fuzz/fuzz_joints.cpp
// Lists of measured joint orientations.
#include "fuzz.hpp"
#include "site/joint_list.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses(
      [&] { static_cast<void>(talus::read_orientations(talus::text_of(data, size), "fuzz.txt")); });
}
