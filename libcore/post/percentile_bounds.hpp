// libcore/post/percentile_bounds.hpp
// How sure percentiles are: one rule for maps and fences.
// in:    values in ascending order, with the block of each and its weight
// out:   which of them are the upper 95 % bounds of the percentiles
//
// - No cluster (ensemble/clusters.hpp) has two values: they are independent, and the binomial
//   distribution of ranks bounds them exactly (Wilks 1941).
// - 30 clusters or more: Woodruff (1952). The interval of the share of the values that do not
// exceed
//   the percentile (share_interval.hpp) is read off the values.
// - 10 to 29 clusters: the bootstrap over clusters. Fewer bound nothing.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "post/share_interval.hpp"
#include "post/statistics.hpp"

namespace talus {

/// Fewer clusters with a value are resampled.
inline constexpr int least_clusters_for_woodruff = 30;

using BoundPlaces = std::array<int, percentile_levels.size()>;

/// Sets of values over the same clusters, one after the other: their common part is computed once.
struct PercentileBounds {
  const Clusters& clusters;
  int n_resamples = 0;
  std::uint64_t seed = 1;                                           ///< of the bootstrap
  std::optional<ClusterResamples> resamples{};                      ///< drawn when first needed
  std::array<std::map<int, int>, percentile_levels.size()> rank{};  ///< of upper bounds, by n
  std::vector<int> place_of_cluster{};  ///< scratch: among those with a value, -1 none (n_clusters)
};

/// Places of the upper bounds of percentile_levels in `ascending`; -1: the sample gives none.
/// Weights > 0; a sample bounds a percentile when it is worth smallest_sample() independent values.
[[nodiscard]] BoundPlaces upper_bound_places(PercentileBounds& bounds,
                                             std::span<const BlockWeight> ascending);

/// A percentile among values in ascending order, and both ends of its 95 % interval; -1: none.
struct BoundedPlaces {
  int place = -1, low = -1, high = -1;
};
/// By ranks, or by Woodruff's method where clusters repeat (30 clusters or more). The percentile
/// needs values worth smallest_sample(p) independent ones.
[[nodiscard]] BoundedPlaces percentile_places(PercentileBounds& bounds,
                                              std::span<const BlockWeight> ascending, double p);

}  // namespace talus
