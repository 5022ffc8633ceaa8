// libcore/post/fence/fence_summary.hpp
// Statistics of arrivals at a fence, at one of its fields or at one of its posts.
// in:    arrivals of all runs (fence.hpp)
// out:   percentiles of energy, height and speed with their bounds; several hits
// Definitions: docs/reference/formats.md#fence
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ensemble/clusters.hpp"
#include "post/fence/fence.hpp"

namespace talus {

/// Resamples of the clusters for a bound at a fence.
inline constexpr int fence_resamples = 400;

/// A percentile with its bounds; NaN where the sample gives none: below the least number of
/// effective arrivals (smallest_sample).
struct BoundedPercentile {
  double value = 0, upper = 0;  ///< 95 % upper bound
};
/// Of one quantity over arrivals: the largest value, and percentiles 50, 90, 95, 99.
struct QuantitySummary {
  double largest = 0;
  std::array<BoundedPercentile, 4> percentile{};
};

struct FencePartSummary {
  int n = 0;                            ///< arrivals over all runs
  double per_run = 0;                   ///< arrivals a run
  double n_eff = 0;                     ///< Kish's effective number of arrivals [-]
  QuantitySummary energy, translation;  ///< kinetic with spin, without [J]
  QuantitySummary top, speed;           ///< height of the top above the base [m], [m/s]
  double mean_angle = 0;                ///< to the normal [rad]
  int most_in_a_run = 0;                ///< hits of one fence in a run: the multi-hit check
  double runs_hit_twice = 0;            ///< share of runs with two hits or more
  double window_energy = 0;             ///< largest sum of energies within one second, any run [J]
  int window_hits = 0;                  ///< of that second
};
/// `clusters`: of all runs, also those without an arrival. Bounds: percentile_bounds.hpp.
[[nodiscard]] FencePartSummary summarise(const std::vector<FenceArrival>& arrivals,
                                         const Clusters& clusters);

}  // namespace talus
