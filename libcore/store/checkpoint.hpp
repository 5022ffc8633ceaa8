// libcore/store/checkpoint.hpp: public
// The state with which a stopped run continues to the same bits. The rows recorded so far are in
// the run file itself; the checkpoint holds the rest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paper/paper_state.hpp"
#include "record/frames.hpp"
#include "record/passages.hpp"
#include "record/run_file.hpp"
#include "scene/state.hpp"

namespace talus {

struct Checkpoint {
  State state;
  PaperState paper;                      ///< empty with law talus
  std::vector<PassageTracker> trackers;  ///< empty when passages are off
  FrameSampler sampler;
  HealthRow interval;       ///< health since the last row
  double energy_start = 0;  ///< of all blocks at time 0 [J]
  int n_done = 0;           ///< rocks of a run of rocks one by one, else all blocks
};

[[nodiscard]] std::vector<std::uint8_t> pack(const Checkpoint& checkpoint);

/// Throws InputError naming `file` for bytes of another version, damaged ones, and those of a scene
/// with another number of blocks or cells.
[[nodiscard]] Checkpoint unpack(const std::vector<std::uint8_t>& bytes, int n_blocks, int n_cells,
                                const std::string& file);

}  // namespace talus
