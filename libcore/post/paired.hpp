// libcore/post/paired.hpp: public
// Difference of the runs of a variant from the site's runs of the same seeds, and how sure it is.
// in:    both sets of runs; amounts by block, such as hits of an object
// out:   difference a run with its 95 % interval
//
// A pair is a cluster (ensemble/clusters.hpp) with its counterpart: the release cell, or the run of
// the same case and seed. The part common to both, such as the rocks that were drawn, is not in the
// interval. It is Student's, of the mean over the pairs; its degrees of freedom are those of the
// pairs that differ, since pairs in which nothing happened say little of how much it scatters.
#pragma once

#include <span>
#include <vector>

#include "ensemble/clusters.hpp"
#include "post/statistics.hpp"

namespace talus {

/// Runs of both sets that have the same case and seed, and the pair that each block belongs to.
struct RunPairs {
  int n_runs = 0;   ///< that both sets have
  int n_pairs = 0;  ///< of clusters
  struct Side {
    std::vector<int> of_run;                 ///< pair of a run, -1: it has none          (n_runs)
    std::vector<std::vector<int>> of_block;  ///< of release cells: pair of each block, by run
    /// On amounts of a run: where runs have no pair, those left of a case count in their place.
    std::vector<double> factor;  //                                                        (n_runs)
  };
  Side site, variant;
};
[[nodiscard]] RunPairs pairs_of(std::span<const RunMember> site,
                                std::span<const RunMember> variant);

struct PairedDifference {
  double site = 0, variant = 0;  ///< amount a run
  double value = 0;              ///< variant - site
  int n_differ = 0;              ///< pairs with another amount
  Interval interval;  ///< 95 %; NaN: fewer than least_clusters pairs, or than two differ,
                      ///< or all by the same
};
/// What follows from an amount a run, and its slope there.
struct AmountCurve {
  double (*value)(double amount) = [](double amount) { return amount; };
  double (*slope)(double amount) = [](double) { return 1.0; };
};
/// `weight` of each block is its amount, times the weight of its run. With a curve all values are
/// those that follow from the amounts, and the interval is that of its tangents on both sides.
[[nodiscard]] PairedDifference paired_difference(const RunPairs& pairs,
                                                 std::span<const BlockWeight> site,
                                                 std::span<const BlockWeight> variant,
                                                 const AmountCurve& curve = {});

}  // namespace talus
