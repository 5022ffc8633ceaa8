// libcore/report/viewer_scene.hpp: public
// A run as the data of the 3-D viewer (tools/report/viewer.js).
// in:    a run with frames, its terrain
// out:   JSON: terrain, blocks, frames, fences, objects, trails and
//        trajectories in local coordinates, arrays in base64
#pragma once

#include <string>
#include <vector>

#include "record/run_file.hpp"
#include "report/texts.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// How much of a run the page may hold.
struct ViewerLimits {
  int max_nodes = 200000;                ///< of the terrain; coarser nodes beyond
  std::size_t max_pose_bytes = 1200000;  ///< of all frames; frames are left out evenly beyond
  std::size_t max_trail_points = 40000;  ///< trails are left out evenly beyond
  std::size_t max_path_points = 8000;    ///< of trajectories: those of the shortest are left out
};

/// Places that are drawn beside the run.
struct ViewerPlaces {
  std::vector<double> fence_height;            ///< one a line of the run, 0 hides it [m]
  std::vector<std::vector<Vec3>> trails = {};  ///< of all runs, local [m]
  double contour_interval = 0;                 ///< 0: no contours [m]
  Vec2 map_corner = Vec2::Zero();              ///< north-west corner of the maps, local [m]
  const Texts* texts = nullptr;                ///< titles of fields in the page's language
};

/// Throws InputError for a run without frames.
[[nodiscard]] std::string viewer_scene(const RunFile& run, const Trn& trn,
                                       const ViewerPlaces& places, const ViewerLimits& limits = {});

}  // namespace talus
