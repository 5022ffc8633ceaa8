// libcore/ensemble/clusters.hpp: public
// Independent clusters among the blocks of a set of runs: all intervals are computed over them.
// in:    the runs, with the cells that their blocks were released in
// out:   the cluster that each block belongs to, and the released mass of each cluster
//
// Blocks of one run are not independent: they move together, or share the draws of the run. Then
// each run is a cluster, and runs of one rock mass are one. Where rocks fall one by one and nothing
// was drawn for a run as a whole, further runs are simply further rocks. Such rocks share the
// ground and the forest below the cell that they come from, in every run: each release cell is a
// cluster, over all runs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ensemble/run_set.hpp"

namespace talus {

/// Fewer clusters of several blocks give no interval.
inline constexpr int least_clusters = 10;

/// A block of a run that counts, e.g. since it came to a place, and its weight.
struct BlockWeight {
  int run = 0, block = 0;
  double weight = 0;
};

struct Clusters {
  enum class Kind { run, rock_mass, release_cell };
  Kind kind = Kind::run;
  std::vector<double> weight;      ///< released by each, times that of its runs       (n_clusters)
  std::vector<int> n_blocks;       ///< released by each, in all runs                  (n_clusters)
  std::vector<int> of_run;         ///< cluster of a run, as shares of runs count it       (n_runs)
  std::vector<double> run_weight;  ///< weight of a run, 1 on average                       (n_runs)
  std::vector<std::vector<int>> of_block;  ///< release cells: cluster of each block  (n_runs x n)
};
[[nodiscard]] inline int n_clusters(const Clusters& clusters) {
  return static_cast<int>(clusters.weight.size());
}
[[nodiscard]] inline int n_runs(const Clusters& clusters) {
  return static_cast<int>(clusters.of_run.size());
}
[[nodiscard]] inline int cluster_of(const Clusters& clusters, int run, int block) {
  return clusters.of_block.empty() ? clusters.of_run[run] : clusters.of_block[run][block];
}

/// Of the runs in this order. Release cells are clusters where there are least_clusters or more of
/// them; rocks of fewer cells say nothing of other cells, and runs are the clusters.
[[nodiscard]] Clusters clusters_of(std::span<const RunMember> runs);

/// "216 release cells"
[[nodiscard]] std::string text(const Clusters& clusters);

}  // namespace talus
