// libcore/post/statistics.hpp: public
// Statistics of a quantity over a sample of blocks or runs, and how sure they are.
// in:    values with weights; counts; the cluster that each value came from (ensemble/clusters.hpp)
// out:   percentiles, confidence bounds, effective sample size
// Every result depends on the values alone, not on their order in the input.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/percentile.hpp"
#include "sampling/normal.hpp"

namespace talus {

/// The percentiles that maps and tables give.
struct PercentileLevel {
  double p;
  const char* name;
};
inline constexpr std::array<PercentileLevel, 4> percentile_levels = {
    {{0.5, "p50"}, {0.9, "p90"}, {0.95, "p95"}, {0.99, "p99"}}};
inline constexpr std::size_t place_of_p95 = 2;  ///< in percentile_levels
static_assert(percentile_levels[place_of_p95].p == 0.95);

/// Kish's effective sample size (sum w)^2 / sum w^2; 0 for no weight.
[[nodiscard]] double effective_size(double sum_of_weights, double sum_of_squared_weights);
[[nodiscard]] double effective_size(std::span<const WeightedValue> values);

struct Interval {
  double low = 0, high = 0;
};

/// Wilson's score interval of a share that was `share` among n trials (n > 0, need not be whole).
/// `z` is the normal quantile: 1.959964 for 95 % between the bounds. Wilson (1927).
[[nodiscard]] Interval wilson_interval(double share, double n, double z = 1.959963984540054);

/// Rank (1 = smallest of n) of the order statistic that is an upper bound of the true p-percentile
/// with at least `confidence`, whatever the distribution: the smallest k with P(Binomial(n, p) <=
/// k - 1) >= confidence. 0 when n is too small for any (Wilks: p = 0.95 needs 59, 0.99 needs 299).
[[nodiscard]] int upper_bound_rank(int n, double p, double confidence = 0.95);

/// The smallest n for which upper_bound_rank() exists: ceil(log(1 - confidence) / log p).
[[nodiscard]] int smallest_sample(double p, double confidence = 0.95);
/// Whether values worth `n` independent ones are so many; the sums of their weights are rounded.
[[nodiscard]] inline bool is_enough(double n, double p) { return n + 1e-9 >= smallest_sample(p); }

/// Ranks of the order statistics that hold the true p-percentile between them with at least
/// `confidence`, whatever the distribution; a rank of 0: none that bounds it there.
struct RankInterval {
  int low = 0, high = 0;
};
[[nodiscard]] RankInterval rank_interval(int n, double p, double confidence = 0.95);

/// The value that Student's variable with `degrees` of freedom, 1 or more, stays below with
/// probability p, 0.5 to 0.999; to 1e-9.
[[nodiscard]] double student_quantile(int degrees, double p);

/// How often each cluster occurs in each resample of all clusters, drawn with replacement: the
/// bootstrap over clusters, which keeps together blocks that are not independent.
struct ClusterResamples {
  int n_clusters = 0, n_resamples = 0;
  int stride = 0;                    ///< n_resamples, rounded up to whole vectors of processors
  std::vector<std::uint16_t> count;  ///< at [cluster * stride + resample]; 0 in the padding

  [[nodiscard]] std::span<const std::uint16_t> of_cluster(int cluster) const {
    return std::span(count).subspan(static_cast<std::size_t>(cluster) * stride, n_resamples);
  }
};
[[nodiscard]] ClusterResamples resample_clusters(int n_clusters, int n_resamples,
                                                 std::uint64_t seed);

/// The weight and cluster of one value.
struct ClusterWeight {
  int cluster = 0;
  double weight = 0;
};

/// Positions in a list of values of the upper bounds of its percentiles, by the bootstrap over
/// clusters: each bound is the `confidence`-percentile of the percentiles of all resamples that
/// hold any weight. `descending`: cluster and weight (>= 0) of each value, the largest value first.
/// `levels`: the percentiles wanted, the largest first. All are found in one pass from the largest
/// value down to the lowest bound. -1: no resample holds any weight (n_levels)
[[nodiscard]] std::vector<int> bootstrap_upper_places(std::span<const ClusterWeight> descending,
                                                      const ClusterResamples& resamples,
                                                      std::span<const double> levels,
                                                      double confidence = 0.95);

}  // namespace talus
