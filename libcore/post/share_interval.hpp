// libcore/post/share_interval.hpp
// How sure a share is: one rule for every map and table that gives one.
// in:    clusters of the blocks (ensemble/clusters.hpp); the blocks that the share counts; how many
//        of the runs that were wanted failed
// out:   95 % interval of the share
//
// Blocks of one cluster are not independent, clusters are. The variance of sum(y) / sum(w) over
// clusters is linearised, which makes the share worth n_eff independent trials; Wilson's interval
// takes these (Korn and Graubard 1998 for the idea). Where every cluster is a single block, each is
// a trial. Runs that failed do not fail at random: with a share f of them R of the rest may be
// anything from R (1 - f), no failed run would have counted, to R (1 - f) + f, all would.
#pragma once

#include <span>
#include <vector>

#include "ensemble/clusters.hpp"
#include "post/statistics.hpp"

namespace talus {

/// Contribution of one cluster to a share: part of whole, 0 <= part <= whole.
struct ClusterShare {
  double part = 0, whole = 0;
};

/// The clusters that a share is over.
struct ShareOver {
  int n = 0;
  double whole = 0;    ///< sum over the clusters
  double squares = 0;  ///< sum of the squares of each cluster's whole
};

/// Basis of a share over clusters.
struct ShareSample {
  double n_trials = 0;  ///< independent trials of the same variance [-]
  /// Degrees of freedom of that variance: clusters with any of it, or without all, the fewer; 0:
  /// the clusters agree, and each is a trial.
  int degrees = 0;
};
/// Of share = sum(part) / sum(whole), 0 to 1; `some`: the clusters that have any part, each once.
[[nodiscard]] ShareSample share_sample(const ShareOver& over, std::span<const ClusterShare> some,
                                       double share);

/// Wilson's interval with the trials of the sample, made fewer by Student's quantile. `p`: 0.975,
/// or 0.95 for a bound on one side: the probability that lies below the upper bound.
[[nodiscard]] Interval sample_interval(const ShareSample& sample, double share, double p = 0.975);

/// The whole that shares are parts of, as their intervals need it.
struct ShareBasis {
  Clusters clusters;
  bool single_blocks = false;      ///< each cluster is one block, or none
  bool bounded = false;            ///< enough clusters for any interval (least_clusters)
  double failed_share = 0;         ///< of the runs that were wanted [-]
  ShareOver over;                  ///< the clusters
  std::vector<double> run_weight;  ///< of runs, those that are one cluster together
  ShareOver runs;                  ///< of those
};
[[nodiscard]] ShareBasis share_basis(Clusters clusters, double failed_share = 0);

/// Of share = sum of the weights of `blocks` / weight of all, 0 to 1. NaN where there are too few
/// clusters.
[[nodiscard]] Interval share_interval(const ShareBasis& basis, std::span<const BlockWeight> blocks,
                                      double share);

/// Of no block (`all` false) or of all: each effective cluster is a trial. NaN where there are too
/// few.
[[nodiscard]] Interval interval_of_none_or_all(const ShareBasis& basis, bool all);

/// Share of the runs that any of these blocks is of, by the runs' weights; the blocks run by run.
[[nodiscard]] double share_of_runs(const ShareBasis& basis, std::span<const BlockWeight> blocks);
/// Of the share of runs in which something happened, each with its weight; each run its own unit,
/// or none of them was hit.
[[nodiscard]] Interval run_share_interval(const ShareBasis& basis, double share);
Interval run_share_interval(const ShareBasis& basis, int n_runs) = delete;  // a count: no share
/// Of share_of_runs().
[[nodiscard]] Interval run_share_interval(const ShareBasis& basis,
                                          std::span<const BlockWeight> blocks);

/// The interval of a share of the runs that did not fail, for all that were wanted.
[[nodiscard]] Interval with_failed(const Interval& interval, double failed_share);

/// How many independent trials a share needs so that its interval is no wider than 2 `half`:
/// Wilson's. `half` > 0.
[[nodiscard]] double trials_for(double share, double half);

/// Runs to add so that an interval is as narrow as wanted.
struct RunsToAdd {
  int n = 0;
  bool help = true;  ///< false: no number of runs does, and `n` is 0
};
/// For the interval of a share of these blocks, to be no wider than 2 `half`. More runs are more
/// clusters; of release cells only the difference between rocks of one cell averages out, and too
/// few rock masses stay too few.
[[nodiscard]] RunsToAdd runs_to_add(const ShareBasis& basis, std::span<const BlockWeight> blocks,
                                    double share, double half);

}  // namespace talus
