// libcore/contact/near_features.hpp
// Features that searches for contacts of a block with the ground keep for the next ones.
#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hpp"
#include "motion/pose.hpp"

namespace talus {

/// The nodes and edges of the ground that one block may touch while it stays near a pose, and with
/// which of its own edges: found with a skin around the block and looked at alone until it has
/// moved by that, as a Verlet list. It changes no contact and no bit.
struct NearFeatures {
  /// A convex node, or a convex edge that the node owns.
  struct Feature {
    std::uint64_t edges = 0;  ///< of the block that may touch it, by bits; all where it has over 64
    int row = 0, col = 0;     ///< node
    std::uint8_t flag = 0;    ///< one of trn_flag
  };
  std::vector<Feature> features;  ///< row by row, as the search goes
  Pose listed;                    ///< where the list was made ...
  Mat3 stretch = Mat3::Zero();    ///< ... and I + strain there
  Pose last;                      ///< where the block was looked for last
  double skin = -1;               ///< the list holds within this from `listed`; < 0: no list [m]
  double margin = 0;              ///< largest margin that it is made for [m]
};

}  // namespace talus
