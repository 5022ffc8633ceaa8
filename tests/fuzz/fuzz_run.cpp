// tests/fuzz/fuzz_run.cpp
// Runs (HDF5), and the checkpoint in them.
#include "fuzz.hpp"
#include "record/run_file.hpp"
#include "store/checkpoint.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return talus::accepts_or_refuses([&] {
    const talus::InputFile file(data, size);
    const talus::RunFile run = talus::read_run_file(file.path());
    if (!run.checkpoint.empty())
      static_cast<void>(talus::unpack(run.checkpoint, talus::n_blocks(run),
                                      run.grid.n_rows * run.grid.n_cols, "fuzz.h5"));
  });
}
