// libcore/step/deep_work.hpp
// Scratch of step/deep_blocks.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "contact/body_overlap.hpp"
#include "contact/ground_depth.hpp"
#include "contact/hulls.hpp"

namespace talus {

/// Scratch of note_deep_blocks, but `is_suspect`, which a step fills.
struct DeepWork {  // clang-format off
  std::vector<std::uint8_t> is_suspect;   ///< 1: by a contact it is deep in something   (n_blocks)
  std::vector<Pose> poses;                ///< at the end of the step                    (n_bodies)
  std::vector<std::uint8_t> moving;       ///< 1: is placed there                        (n_blocks)
  std::vector<Mat3> stretch;              ///< empty for rigid blocks                    (n_bodies)
  PlacedHulls placed;
  BodyOverlapScratch overlaps;
  GroundDepthScratch ground;
  std::vector<double> overlap_depth;      ///< with other bodies [m]                     (n_blocks)
  std::vector<int> overlap_partner;       ///<                                           (n_blocks)
};  // clang-format on

}  // namespace talus
