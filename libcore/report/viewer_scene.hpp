// libcore/report/viewer_scene.hpp: public
// A run as the data of the 3-D viewer (tools/report/viewer.js).
// in:    a run with frames, its terrain
// out:   JSON: terrain, blocks, frames and fences in local coordinates, arrays in base64
#pragma once

#include <string>
#include <vector>

#include "record/run_file.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// How much of a run the page may hold.
struct ViewerLimits {
  int max_nodes = 200000;                ///< of the terrain; coarser nodes beyond
  std::size_t max_pose_bytes = 6000000;  ///< of all frames; frames are left out evenly beyond
};

/// `fence_height_m`: one a line of the run, 0 hides it. Throws InputError for a run without frames.
[[nodiscard]] std::string viewer_scene(const RunFile& run, const Trn& trn,
                                       const std::vector<double>& fence_height_m,
                                       const ViewerLimits& limits = {});

}  // namespace talus
