// libcore/post/share_interval.hpp
// How sure a share is: one rule for every map and table that gives one.
// in:    weight that each run released; of each run the part that the share counts; how many of the
//        runs that were wanted failed
// out:   95 % interval of the share
//
// Blocks of one run are not independent, runs are. The variance of sum(y) / sum(w) over runs is
// linearised, which makes the share worth n_eff independent trials; Wilson's interval takes these
// (Korn and Graubard 1998 for the idea). Where every run released a single block, each is a trial.
// Runs that failed do not fail at random: with a share f of them R of the rest may be anything from
// R (1 - f), no failed run would have counted, to R (1 - f) + f, all would.
#pragma once

#include <span>
#include <vector>

#include "post/statistics.hpp"

namespace talus {

/// What one run adds to a share: part of whole, 0 <= part <= whole.
struct RunShare {
  double part = 0, whole = 0;
};

/// The runs that a share is over.
struct ShareOver {
  int n_runs = 0;
  double whole = 0;    ///< sum over the runs
  double squares = 0;  ///< sum of the squares of each run's whole
};

/// What a share over runs rests on.
struct ShareSample {
  double n_trials = 0;  ///< independent trials of the same variance [-]
  /// Degrees of freedom of that variance: runs with any of it, or without all, the fewer; 0: the
  /// runs agree, and each is a trial.
  int degrees = 0;
};
/// Of share = sum(part) / sum(whole), 0 to 1; `some`: the runs that have any part, each once.
[[nodiscard]] ShareSample share_sample(const ShareOver& over, std::span<const RunShare> some,
                                       double share);

/// Wilson's interval with the trials of the sample, made fewer by Student's quantile. `p`: 0.975,
/// or 0.95 for a bound on one side: the probability that lies below the upper bound.
[[nodiscard]] Interval sample_interval(const ShareSample& sample, double share, double p = 0.975);

/// The whole that shares are parts of, as their intervals need it.
struct ShareBasis {
  std::vector<double> released;  ///< weight of each run                               (n_runs)
  bool single_blocks = false;    ///< no run released more than one block
  bool bounded = false;          ///< enough runs for any interval (least_runs_to_resample)
  ShareOver over;
  double n_eff = 0;         ///< effective number of runs [-]
  double failed_share = 0;  ///< of the runs that were wanted [-]
  ShareOver runs;           ///< the runs themselves, 1 each unless they are weighed
};
[[nodiscard]] ShareBasis share_basis(std::span<const double> released, bool single_blocks,
                                     double failed_share = 0);

/// Of share = sum(parts) / sum(released), 0 to 1; `parts` names only runs that add something, each
/// once. NaN where there are too few runs.
[[nodiscard]] Interval share_interval(const ShareBasis& basis, std::span<const RunWeight> parts,
                                      double share);

/// Runs that do not all count alike, e.g. those of weighed cases.                  (n_runs)
void weigh_runs_of(ShareBasis& basis, std::span<const double> run_weight);

/// How many trials the share is worth (share_sample); NaN where there are too few runs.
[[nodiscard]] double trials_of(const ShareBasis& basis, std::span<const RunWeight> parts,
                               double share);

/// Of no block (`all` false) or of all: each effective run is a trial. NaN where there are too few.
[[nodiscard]] Interval interval_of_none_or_all(const ShareBasis& basis, bool all);

/// Of the share of runs in which something happened, each run with its weight.
[[nodiscard]] Interval run_share_interval(const ShareBasis& basis, double share);
Interval run_share_interval(const ShareBasis& basis, int n_runs) = delete;  // a count is no share

/// The interval of a share of the runs that did not fail, for all that were wanted.
[[nodiscard]] Interval with_failed(const Interval& interval, double failed_share);

/// How many independent trials a share needs so that its interval is no wider than 2 `half`:
/// Wilson's. `half` > 0.
[[nodiscard]] double trials_for(double share, double half);

/// Runs to add to `n_runs` so that the interval of a share, now worth `n_trials`, is no wider than
/// 2 `half`; 0: none.
[[nodiscard]] int runs_to_add(int n_runs, double n_trials, double share, double half);

}  // namespace talus
