// Weighted percentiles, confidence bounds and effective sample sizes.
#include "post/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/error.hpp"
#include "base/random.hpp"

namespace talus {
namespace {

// p n and sums of weights are rounded; values that differ by less than this share are equal.
constexpr double rounding = 1e-12;

double log_binomial_pmf(int n, double p, int k) {
  return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(p) +
         (n - k) * std::log1p(-p);
}

// Rank of the p-percentile among n values, 1 the smallest.
std::size_t rank_of(double p, std::size_t n) {
  const double rank = std::ceil(p * static_cast<double>(n) * (1 - rounding));
  return static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(n)));
}

constexpr int most_exact_degrees = 100;

// P(T <= t) of Student's variable by its finite sums: Abramowitz and Stegun 26.7.3 and 26.7.4.
double student_probability(double t, int degrees) {
  const double theta = std::atan2(t, std::sqrt(static_cast<double>(degrees)));
  const double cos_sq = std::pow(std::cos(theta), 2);
  const bool is_odd = degrees % 2 == 1;
  double term = is_odd ? std::cos(theta) : 1, sum = degrees == 1 ? 0 : term;
  for (int k = is_odd ? 3 : 2; k <= degrees - 2; k += 2) {
    term *= cos_sq * (k - 1) / k;
    sum += term;
  }
  const double inside =
      is_odd ? 2 / std::numbers::pi * (theta + std::sin(theta) * sum) : std::sin(theta) * sum;
  return 0.5 * (1 + inside);
}

// Where a function that rises reaches p, by bisection.
template <class Function>
double solved(const Function& rising, double p) {
  double low = -1, high = 1;
  while (rising(low) > p) low *= 2;
  while (rising(high) < p) high *= 2;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (rising(middle) < p ? low : high) = middle;
  }
  return high;
}

// Resamples are worked on in groups of this size, which the compiler turns into vectors.
constexpr int lanes = 16;

// sum[b] += weight * count[b] for all resamples.
template <class T>
void add_to_resamples(T* sum, const ClusterResamples& resamples, int cluster, T weight) {
  const std::uint16_t* count =
      resamples.count.data() + static_cast<std::size_t>(cluster) * resamples.stride;
  for (int b = 0; b < resamples.stride; b += lanes, sum += lanes, count += lanes)
    for (int k = 0; k < lanes; ++k) sum[k] += weight * static_cast<T>(count[k]);
}

template <class T>
int count_above(const std::vector<T>& sum, const std::vector<T>& limit) {
  int n = 0;
  const T *a = sum.data(), *b = limit.data();
  for (std::size_t i = 0; i < sum.size(); i += lanes, a += lanes, b += lanes)
    for (int k = 0; k < lanes; ++k) n += a[k] > b[k];
  return n;
}

// bootstrap_upper_places() with sums of type T, exact in integers where all weights are equal.
// The p-percentile of a resample is the first value, from the largest down, that with those above
// it holds more than the share 1 - p of the weight.
template <class T>
std::vector<int> places_of(std::span<const ClusterWeight> descending,
                           const ClusterResamples& resamples, std::span<const double> levels,
                           double confidence, double unit) {
  const auto n = static_cast<std::size_t>(resamples.stride);
  std::vector<T> total(n, T{});
  std::map<int, T> of_cluster;
  for (const ClusterWeight& item : descending)
    of_cluster[item.cluster] += static_cast<T>(item.weight / unit);
  for (const auto& [cluster, weight] : of_cluster)
    if (weight > 0) add_to_resamples(total.data(), resamples, cluster, weight);
  const auto n_valid = static_cast<std::size_t>(
      std::count_if(total.begin(), total.end(), [](T t) { return t > 0; }));
  std::vector<int> places(levels.size(), -1);
  if (n_valid == 0) return places;
  const auto needed = static_cast<int>(n_valid - rank_of(confidence, n_valid) + 1);
  std::vector<T> above(n, T{}), limit(n, std::numeric_limits<T>::max());
  std::size_t level = 0;
  const auto set_limits = [&] {
    const double share = 1 - levels[level] * (1 - rounding);
    for (std::size_t b = 0; b < n; ++b)
      if (total[b] > 0) limit[b] = static_cast<T>(static_cast<double>(total[b]) * share);
  };
  set_limits();
  for (std::size_t i = 0; i < descending.size(); ++i) {
    add_to_resamples(above.data(), resamples, descending[i].cluster,
                     static_cast<T>(descending[i].weight / unit));
    while (count_above(above, limit) >= needed) {
      places[level] = static_cast<int>(i);
      if (++level == levels.size()) return places;
      set_limits();
    }
  }
  return places;
}

}  // namespace

double effective_size(double sum_of_weights, double sum_of_squared_weights) {
  if (!(sum_of_squared_weights > 0)) return 0;
  return sum_of_weights * sum_of_weights / sum_of_squared_weights;
}

double effective_size(std::span<const WeightedValue> values) {
  double sum = 0, squares = 0;
  for (const WeightedValue& value : values) {
    sum += value.weight;
    squares += value.weight * value.weight;
  }
  return effective_size(sum, squares);
}

Interval wilson_interval(double share, double n, double z) {
  TALUS_ASSERT(n > 0 && share >= 0 && share <= 1);
  const double z_sq = z * z;
  const double middle = share + z_sq / (2 * n);
  const double half = z * std::sqrt(share * (1 - share) / n + z_sq / (4 * n * n));
  const double scale = 1 / (1 + z_sq / n);
  return {share > 0 ? std::max(0.0, (middle - half) * scale) : 0,
          share < 1 ? std::min(1.0, (middle + half) * scale) : 1};
}

int upper_bound_rank(int n, double p, double confidence) {
  TALUS_ASSERT(n >= 0 && p > 0 && p < 1);
  // Adds P(B = j) from above all that has any probability, until the tail P(B >= k) is too heavy.
  const double spread = std::sqrt(n * p * (1 - p));
  int k = static_cast<int>(std::min<double>(n, std::ceil(n * p + 12 * spread + 12))) + 1;
  const double allowed = (1 - confidence) * (1 + rounding);
  double tail = 0;
  while (k > 1) {
    tail += std::exp(log_binomial_pmf(n, p, k - 1));
    if (tail > allowed) break;
    --k;
  }
  return k > n ? 0 : k;
}

int smallest_sample(double p, double confidence) {
  return static_cast<int>(std::ceil(std::log1p(-confidence) / std::log(p) * (1 - rounding)));
}

RankInterval rank_interval(int n, double p, double confidence) {
  const double one_side = (1 + confidence) / 2;
  const int from_above = upper_bound_rank(n, 1 - p, one_side);
  return {from_above > 0 ? n + 1 - from_above : 0, upper_bound_rank(n, p, one_side)};
}

double student_quantile(int degrees, double p) {
  TALUS_ASSERT(degrees >= 1 && p >= 0.5 && p < 1);
  if (degrees <= most_exact_degrees)
    return solved([degrees](double t) { return student_probability(t, degrees); }, p);
  // Cornish and Fisher's expansion in 1 / degrees: Abramowitz and Stegun 26.7.5
  const double z = normal_quantile(p), z2 = z * z, n = degrees;
  const double a = (z2 + 1) / 4, b = ((5 * z2 + 16) * z2 + 3) / 96,
               c = (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384,
               d = ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
  return z * (1 + (a + (b + (c + d / n) / n) / n) / n);
}

ClusterResamples resample_clusters(int n_clusters, int n_resamples, std::uint64_t seed) {
  TALUS_ASSERT(n_clusters > 0 && n_resamples > 0);
  ClusterResamples resamples{
      n_clusters, n_resamples, (n_resamples + lanes - 1) / lanes * lanes, {}};
  resamples.count.assign(static_cast<std::size_t>(n_clusters) * resamples.stride, 0);
  Random random(seed, "bootstrap over runs");
  for (int b = 0; b < n_resamples; ++b)
    for (int draw = 0; draw < n_clusters; ++draw)
      ++resamples.count[random.below(n_clusters) * resamples.stride + b];
  return resamples;
}

std::vector<int> bootstrap_upper_places(std::span<const ClusterWeight> descending,
                                        const ClusterResamples& resamples,
                                        std::span<const double> levels, double confidence) {
  TALUS_ASSERT(std::is_sorted(levels.rbegin(), levels.rend()));
  if (descending.empty() || levels.empty()) return std::vector<int>(levels.size(), -1);
  const double unit = descending[0].weight;
  const bool equal = unit > 0 && std::all_of(descending.begin(), descending.end(),
                                             [unit](auto& item) { return item.weight == unit; });
  return equal ? places_of<std::int32_t>(descending, resamples, levels, confidence, unit)
               : places_of<double>(descending, resamples, levels, confidence, 1);
}

}  // namespace talus
