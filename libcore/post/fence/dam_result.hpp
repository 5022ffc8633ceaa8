// libcore/post/fence/dam_result.hpp: public
// Blocks that reach a dam in the terrain, those that pass over its crest, and whether it holds; of
// a gallery the hits of its roof. in:    runs at the two lines of each dam (watched_dams() of
// setup/site_dams_gdal.hpp), read as the
//        lines of fences that stop nothing
// out:   a verdict a block, statistics of arrivals and of passages, a verdict on the whole
// Definitions: docs/guide/dams.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "post/fence/fence_result.hpp"
#include "record/crossings.hpp"

namespace talus {

/// A dam of the site file: its lines among those of the runs.
struct DamCase {
  std::string name;
  bool is_gallery = false;             ///< its crest is the valley edge of its roof
  double height = 0;                   ///< of the crest above the ground, as designed [m]
  double capacity = 0;                 ///< energy that it is designed for [J]; NaN: not given
  std::size_t arrival = 0, crest = 0;  ///< indices of RunAtFence
  RecordLine line;                     ///< of the crest
  int uphill = 1;                      ///< +1: left of it seen from its first point, -1: right
};

/// The block at a percentile of the energy normal to the roof, or with the largest.
struct LoadCase {
  const char* name;              ///< "p50", "p95", "p99", "max"
  std::optional<RoofLoad> load;  ///< none: too few hits
};

struct DamResult {
  FencePartSummary arriving;  ///< at the line before the uphill face
  FencePartSummary passing;   ///< over the crest
  int n_moving = 0;  ///< blocks that had neither passed it nor come to rest when their run ended
  int n_from_downhill = 0;   ///< blocks that came to the crest first from the other side
  int n_ended_downhill = 0;  ///< blocks on the other side at the end that did not come to it
  double energy_use = 0;     ///< 95th percentile of the energy over the capacity [-]; NaN: unknown
  DesignVerdict verdict = DesignVerdict::nothing_came;  ///< meets: it holds
  std::string text;                                     ///< the verdict in words
  int n_loads = 0, n_hits = 0;       ///< blocks that hit the roof, and how often they did
  std::vector<LoadCase> load_cases;  ///< of a gallery
};

/// Of each block, in place of the verdicts at the dam's first line: stopped where it came to the
/// dam, or onto the roof of the gallery, and did not pass its crest, overtopped where it did,
/// bypassed where it came from uphill beside an end and ended on the other side, else not reached.
void set_verdicts(FenceRunGroup& group, const DamCase& dam);

/// It holds when no block passed over the crest or came to it from downhill, none of the others
/// moves any more, and the 95th percentile of the energy of those that came is no more than the
/// capacity. No factor and no freeboard of a code is in it. A gallery is not judged.
[[nodiscard]] DamResult dam_result(const DamCase& dam, const FenceRunGroup& group);

/// "dam road: 280 blocks of 10 runs: 251 stopped, 29 not reached; 251 came, largest energy ..."
[[nodiscard]] std::string dam_summary(const DamCase& dam, const DamResult& result,
                                      const FenceRunGroup& group);

}  // namespace talus
