// libcore/post/share_interval.hpp
// How sure a share of all released blocks is: one rule for every map and table that gives a share.
// in:    weight that each run released; of each run the part that the share counts
// out:   95 % interval of the share
// Wilson's where every run released a single block, since then blocks are independent trials; else
// the bootstrap over runs, since blocks of one run are not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "post/statistics.hpp"

namespace talus {

/// The whole that shares are parts of, as their intervals need it.
struct ShareBasis {
  bool single_blocks = false;  ///< no run released more than one block
  bool bounded = false;        ///< enough runs for any interval (least_runs_to_resample)
  double n_eff = 0;            ///< effective number of runs [-]
  RunResamples resamples;      ///< none where Wilson's interval serves
  std::vector<double> whole;   ///< released weight of each resample             (n_resamples)
};
/// `released`: weight of the blocks of each run (n_runs). `seed`: of the bootstrap.
[[nodiscard]] ShareBasis share_basis(std::span<const double> released, bool single_blocks,
                                     int n_resamples, std::uint64_t seed);

/// Of share = sum(parts) / sum(released), 0 to 1; `parts` names only runs that add something. NaN
/// where there are too few runs.
[[nodiscard]] Interval share_interval(const ShareBasis& basis, std::span<const RunWeight> parts,
                                      double share);

/// Of no block (`all` false) or of all: runs that agree have no spread to resample, so it is
/// Wilson's with the effective number of runs. NaN where there are too few runs.
[[nodiscard]] Interval interval_of_none_or_all(const ShareBasis& basis, bool all);

}  // namespace talus
