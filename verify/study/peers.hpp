// verify/study/peers.hpp
// Results of other engines on the same cases, from tables measured elsewhere: for the diagrams and
// one column of the summary.
// in:    a folder with sliding.csv, sliding_friction_angles.csv, oblique.csv, rolling.csv,
//        bounce.csv, free_rotation.csv and slide39_seeds.csv
#pragma once

#include <string>
#include <vector>

#include "verify/study/measure.hpp"

namespace talus {

/// Runs of other engines of the case of that name; empty where the tables have none. Throws
/// InputError for a table that is missing or lacks a column.
[[nodiscard]] std::vector<PeerPoint> read_peers(const std::string& folder,
                                                const std::string& case_name);

/// A mean over seeds of one engine and setting on the slide of 39 blocks.
struct PeerSlide {
  std::string name;
  double centre = 0;  ///< mean position down the slope [m]
  double cpu = 0;     ///< of one run of 20 s [s]
};
[[nodiscard]] std::vector<PeerSlide> read_peer_slides(const std::string& folder);

}  // namespace talus
