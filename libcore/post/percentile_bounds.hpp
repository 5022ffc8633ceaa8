// libcore/post/percentile_bounds.hpp
// How sure percentiles are: one rule for maps and fences.
// in:    values in ascending order, with weight and run
// out:   which of them are the upper 95 % bounds of the percentiles
//
// - No run has two values: they are independent, and the binomial distribution of ranks bounds them
//   exactly (Wilks 1941).
// - 30 runs or more: Woodruff (1952). The interval of the share of the values that do not exceed
// the
//   percentile (share_interval.hpp) is read off the values.
// - 10 to 29 runs: the bootstrap over runs. Fewer bound nothing.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "post/share_interval.hpp"
#include "post/statistics.hpp"

namespace talus {

/// Fewer runs with a value are resampled.
inline constexpr int least_runs_for_woodruff = 30;

using BoundPlaces = std::array<int, percentile_levels.size()>;

/// Sets of values over the same runs, one after the other: what they share is computed once.
struct PercentileBounds {
  PercentileBounds(int runs, int resamples_of_runs, std::uint64_t seed_of_them)
      : n_runs(runs), n_resamples(resamples_of_runs), seed(seed_of_them) {}

  int n_runs = 0;
  int n_resamples = 0;
  std::uint64_t seed = 0;                                         ///< of the bootstrap
  std::optional<RunResamples> resamples;                          ///< drawn when first needed
  std::array<std::map<int, int>, percentile_levels.size()> rank;  ///< of upper bounds, by n
  std::vector<int> place_of_run;  ///< scratch: among the runs with a value, -1 none      (n_runs)
};

/// Places of the upper bounds of percentile_levels in `ascending`; -1: the sample gives none.
/// Weights > 0; a sample bounds a percentile when it is worth smallest_sample() independent values.
[[nodiscard]] BoundPlaces upper_bound_places(PercentileBounds& bounds,
                                             std::span<const RunWeight> ascending);

/// A percentile among values in ascending order, and both ends of its 95 % interval; -1: none.
struct BoundedPlaces {
  int place = -1, low = -1, high = -1;
};
/// By ranks, or by Woodruff's method where runs repeat (30 runs or more). The percentile needs
/// values worth smallest_sample(p) independent ones.
[[nodiscard]] BoundedPlaces percentile_places(std::span<const RunWeight> ascending, double p);

}  // namespace talus
