// tools/frame/whole_runs.hpp
// Which runs keep all of their frames once they have ended.
#pragma once

#include <cmath>
#include <cstdint>

#include "site/site.hpp"

namespace talus {

/// With [output] frames, or of a share s of the runs those at whose seed another whole number of s
/// is begun: seeds 1, 101, 201 ... of 0.01.
[[nodiscard]] inline bool keeps_frames(const OutputSettings& output, std::int64_t seed) {
  const auto n = static_cast<double>(seed);
  return output.frames ||
         std::ceil(n * output.whole_share) > std::ceil((n - 1) * output.whole_share);
}

}  // namespace talus
