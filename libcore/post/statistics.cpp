#include "post/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/random.hpp"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
// p n and sums of weights are rounded; what differs by less than this share is equal.
constexpr double rounding = 1e-12;

double log_binomial_pmf(int n, double p, int k) {
  return std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(p) +
         (n - k) * std::log1p(-p);
}

// Entry of rank ceil(p n) of an ascending list; NaN when it is empty.
double percentile_of_sorted(const std::vector<double>& sorted, double p) {
  if (sorted.empty()) return none;
  const double n = static_cast<double>(sorted.size());
  const double rank = std::ceil(p * n * (1 - rounding));
  return sorted[static_cast<std::size_t>(std::clamp(rank, 1.0, n)) - 1];
}

}  // namespace

double weighted_percentile(std::span<const WeightedValue> sorted, double p) {
  double total = 0;
  for (const WeightedValue& v : sorted) total += v.weight;
  if (!(total > 0)) return none;
  double sum = 0;
  for (const WeightedValue& v : sorted) {
    sum += v.weight;
    if (v.weight > 0 && sum >= p * total * (1 - rounding)) return v.value;
  }
  return sorted.back().value;
}

void sort_values(std::span<WeightedValue> values) {
  std::sort(values.begin(), values.end(), [](const WeightedValue& a, const WeightedValue& b) {
    return a.value != b.value ? a.value < b.value : a.weight < b.weight;
  });
}

double effective_size(double sum_of_weights, double sum_of_squared_weights) {
  if (!(sum_of_squared_weights > 0)) return 0;
  return sum_of_weights * sum_of_weights / sum_of_squared_weights;
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

int lower_bound_rank(int n, double p, double confidence) {
  const int mirrored = upper_bound_rank(n, 1 - p, confidence);
  return mirrored == 0 ? 0 : n + 1 - mirrored;
}

int smallest_sample(double p, double confidence) {
  return static_cast<int>(std::ceil(std::log1p(-confidence) / std::log(p) * (1 - rounding)));
}

RunResamples resample_runs(int n_runs, int n_resamples, std::uint64_t seed) {
  TALUS_ASSERT(n_runs > 0 && n_resamples > 0);
  RunResamples resamples{n_runs, n_resamples, {}};
  resamples.count.assign(static_cast<std::size_t>(n_runs) * n_resamples, 0);
  Random random(seed, "bootstrap over runs");
  for (int b = 0; b < n_resamples; ++b)
    for (int draw = 0; draw < n_runs; ++draw)
      ++resamples.count[random.below(n_runs) * n_resamples + b];
  return resamples;
}

double bootstrap_upper_percentile(std::span<const RunValue> sorted, const RunResamples& resamples,
                                  double p, double confidence) {
  const auto n = static_cast<std::size_t>(resamples.n_resamples);
  std::vector<double> total(n, 0.0), above(n, 0.0), percentile(n, none);
  for (const RunValue& v : sorted) {
    const auto count = resamples.of_run(v.run);
    for (std::size_t b = 0; b < n; ++b) total[b] += v.weight * count[b];
  }
  // From the largest value down: the percentile is the first one that leaves less than p below it.
  std::size_t open = n;
  for (const RunValue& v : sorted) {
    if (open == 0) break;
    const auto count = resamples.of_run(v.run);
    for (std::size_t b = 0; b < n; ++b) {
      above[b] += v.weight * count[b];
      if (count[b] == 0 || !std::isnan(percentile[b])) continue;
      if (total[b] - above[b] >= p * total[b] * (1 - rounding)) continue;
      percentile[b] = v.value;
      --open;
    }
  }
  std::erase_if(percentile, [](double value) { return std::isnan(value); });
  std::sort(percentile.begin(), percentile.end());
  return percentile_of_sorted(percentile, confidence);
}

std::vector<double> resampled_sums(const RunResamples& resamples, std::span<const double> of_run) {
  TALUS_ASSERT(static_cast<int>(of_run.size()) == resamples.n_runs);
  std::vector<double> sums(static_cast<std::size_t>(resamples.n_resamples), 0.0);
  for (int run = 0; run < resamples.n_runs; ++run) {
    const auto count = resamples.of_run(run);
    for (std::size_t b = 0; b < sums.size(); ++b) sums[b] += of_run[run] * count[b];
  }
  return sums;
}

Interval bootstrap_share(std::span<const RunWeight> parts, std::span<const double> whole,
                         const RunResamples& resamples, double confidence) {
  std::vector<double> shares(whole.size(), 0.0);
  for (const RunWeight& part : parts) {
    const auto count = resamples.of_run(part.run);
    for (std::size_t b = 0; b < shares.size(); ++b) shares[b] += part.weight * count[b];
  }
  for (std::size_t b = 0; b < shares.size(); ++b) shares[b] /= whole[b];
  std::erase_if(shares, [](double share) { return std::isnan(share); });
  std::sort(shares.begin(), shares.end());
  return {percentile_of_sorted(shares, (1 - confidence) / 2),
          percentile_of_sorted(shares, (1 + confidence) / 2)};
}

}  // namespace talus
