// 95 % intervals of shares over clusters: one rule for every map and table.
#include "post/share_interval.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace talus {
namespace {

constexpr double rounding = 1e-24;  // of squares of weights: a smaller value is not a variance
constexpr double whole_cluster = 1 - 1e-12;

double effective_number(const ShareOver& over) { return effective_size(over.whole, over.squares); }

// A share of blocks is at most that of the clusters with any, and at least that of the clusters
// with all.
Interval within_clusters(const Interval& interval, const ShareOver& over,
                         std::span<const ClusterShare> some) {
  double any = 0, all = 0;
  for (const ClusterShare& cluster : some) {
    any += cluster.whole;
    if (cluster.part >= cluster.whole * whole_cluster) all += cluster.whole;
  }
  const double n_eff = effective_number(over);
  const auto of_clusters = [&](double weight) {
    return wilson_interval(std::min(1.0, weight / over.whole), n_eff);
  };
  Interval out = interval;
  if (static_cast<int>(some.size()) < over.n) out.high = std::min(out.high, of_clusters(any).high);
  if (all > 0) out.low = std::max(out.low, of_clusters(all).low);
  return out;
}

ShareOver over_of(const std::vector<double>& weights) {
  ShareOver over{static_cast<int>(weights.size()), 0, 0};
  for (const double weight : weights) {
    over.whole += weight;
    over.squares += weight * weight;
  }
  return over;
}

Interval interval_over(const ShareOver& over, std::span<const ClusterShare> some, double share) {
  return within_clusters(sample_interval(share_sample(over, some, share), share), over, some);
}

template <class Take>
void for_each_run(std::span<const BlockWeight> blocks, const Take& take) {
  int last = -1;
  for (const BlockWeight& block : blocks) {
    if (block.run != last) take(block.run);
    last = block.run;
  }
}

// The clusters with any part.
struct NumberedShare {
  int cluster = 0;
  ClusterShare share;
};
std::vector<NumberedShare> numbered_shares(const Clusters& clusters,
                                           std::span<const BlockWeight> blocks) {
  std::vector<ClusterWeight> parts;
  parts.reserve(blocks.size());
  for (const BlockWeight& block : blocks)
    if (block.weight > 0)
      parts.push_back({cluster_of(clusters, block.run, block.block), block.weight});
  const auto before = [](const ClusterWeight& a, const ClusterWeight& b) {
    return a.cluster < b.cluster;
  };
  if (!std::is_sorted(parts.begin(), parts.end(), before))
    std::stable_sort(parts.begin(), parts.end(), before);
  std::vector<NumberedShare> out;
  for (const ClusterWeight& part : parts) {
    if (out.empty() || out.back().cluster != part.cluster)
      out.push_back({part.cluster, {0, clusters.weight[part.cluster]}});
    out.back().share.part += part.weight;
  }
  return out;
}

std::vector<ClusterShare> shares_of(const Clusters& clusters, std::span<const BlockWeight> blocks) {
  std::vector<ClusterShare> some;
  for (const NumberedShare& one : numbered_shares(clusters, blocks)) some.push_back(one.share);
  return some;
}

// How many trials a share is worth (share_sample).
double trials_of(const ShareBasis& basis, std::span<const BlockWeight> blocks, double share) {
  if (basis.single_blocks) return effective_number(basis.over);
  return share_sample(basis.over, shares_of(basis.clusters, blocks), share).n_trials;
}

// Variance of a share that is within clusters: between blocks of one. The difference between
// clusters of one block may all be of this kind.
double variance_within(const ShareBasis& basis, std::span<const BlockWeight> blocks, double share) {
  double sum = 0;
  std::vector<bool> has_any(static_cast<std::size_t>(basis.over.n), false);
  const auto square = [](double x) { return x * x; };
  for (const NumberedShare& one : numbered_shares(basis.clusters, blocks)) {
    has_any[one.cluster] = true;
    const auto [part, whole] = one.share;
    const int n = basis.clusters.n_blocks[one.cluster];
    sum += n < 2 ? square(part - share * whole) : part * std::max(0.0, whole - part) / (n - 1);
  }
  for (int c = 0; c < basis.over.n; ++c)
    if (!has_any[c] && basis.clusters.n_blocks[c] < 2)
      sum += square(share * basis.clusters.weight[c]);
  return sum / square(basis.over.whole);
}

}  // namespace

ShareSample share_sample(const ShareOver& over, std::span<const ClusterShare> some, double share) {
  const double n = over.n;
  double squares = 0, squares_of_some = 0;
  int n_all = 0;
  for (const ClusterShare& cluster : some) {
    const double off = cluster.part - share * cluster.whole;
    squares += off * off;
    squares_of_some += cluster.whole * cluster.whole;
    n_all += cluster.part >= cluster.whole * whole_cluster;
  }
  const int n_some = static_cast<int>(some.size());
  if (n_some < over.n) squares += share * share * std::max(0.0, over.squares - squares_of_some);
  if (over.n < 2 || squares <= rounding * over.squares) return {effective_number(over), 0};
  const double variance = n / (n - 1) * squares / (over.whole * over.whole);
  return {share * (1 - share) / variance, std::max(1, std::min(n_some, over.n - n_all))};
}

Interval sample_interval(const ShareSample& sample, double share, double p) {
  const double z = normal_quantile(p);
  double n = sample.n_trials;
  if (sample.degrees > 0) n *= std::pow(z / student_quantile(sample.degrees, p), 2);
  return wilson_interval(share, n, z);
}

ShareBasis share_basis(Clusters clusters, double failed_share) {
  ShareBasis basis;
  basis.single_blocks =
      std::all_of(clusters.n_blocks.begin(), clusters.n_blocks.end(), [](int n) { return n <= 1; });
  basis.over = over_of(clusters.weight);
  basis.bounded = basis.single_blocks || basis.over.n >= least_clusters;
  basis.failed_share = failed_share;
  for (std::size_t run = 0; run < clusters.of_run.size(); ++run) {
    const auto at = static_cast<std::size_t>(clusters.of_run[run]);
    if (at >= basis.run_weight.size()) basis.run_weight.resize(at + 1);
    basis.run_weight[at] += clusters.run_weight[run];
  }
  basis.runs = over_of(basis.run_weight);
  basis.clusters = std::move(clusters);
  return basis;
}

Interval share_interval(const ShareBasis& basis, std::span<const BlockWeight> blocks,
                        double share) {
  if (!basis.bounded) return {no_value, no_value};
  if (basis.single_blocks)
    return with_failed(wilson_interval(share, effective_number(basis.over)), basis.failed_share);
  return with_failed(interval_over(basis.over, shares_of(basis.clusters, blocks), share),
                     basis.failed_share);
}

Interval interval_of_none_or_all(const ShareBasis& basis, bool all) {
  if (!basis.bounded) return {no_value, no_value};
  return with_failed(wilson_interval(all ? 1 : 0, effective_number(basis.over)),
                     basis.failed_share);
}

double share_of_runs(const ShareBasis& basis, std::span<const BlockWeight> blocks) {
  double weight = 0;
  for_each_run(blocks, [&](int run) { weight += basis.clusters.run_weight[run]; });
  return std::min(1.0, weight / basis.runs.whole);
}

Interval run_share_interval(const ShareBasis& basis, double share) {
  return with_failed(wilson_interval(share, effective_number(basis.runs)), basis.failed_share);
}

Interval run_share_interval(const ShareBasis& basis, std::span<const BlockWeight> blocks) {
  const double share = share_of_runs(basis, blocks);
  if (basis.runs.n == n_runs(basis.clusters)) return run_share_interval(basis, share);
  if (basis.runs.n < least_clusters) return {no_value, no_value};
  std::vector<double> hit(basis.run_weight.size(), 0);
  for_each_run(blocks,
               [&](int run) { hit[basis.clusters.of_run[run]] += basis.clusters.run_weight[run]; });
  std::vector<ClusterShare> some;
  for (std::size_t u = 0; u < hit.size(); ++u)
    if (hit[u] > 0) some.push_back({hit[u], basis.run_weight[u]});
  return with_failed(interval_over(basis.runs, some, share), basis.failed_share);
}

Interval with_failed(const Interval& interval, double failed_share) {
  return {interval.low * (1 - failed_share), interval.high * (1 - failed_share) + failed_share};
}

// Half of Wilson's interval falls with n.
double trials_for(double share, double half) {
  TALUS_ASSERT(half > 0);
  double low = 1e-3, high = 1;
  const auto is_too_wide = [&](double n) {
    const double z = normal_quantile(0.975);
    const double spread = share * (1 - share) / n + z * z / (4 * n * n);
    return z * std::sqrt(spread) / (1 + z * z / n) > half;
  };
  while (is_too_wide(high)) high *= 2;
  for (int i = 0; i < 100; ++i) (is_too_wide((low + high) / 2) ? low : high) = (low + high) / 2;
  return high;
}

RunsToAdd runs_to_add(const ShareBasis& basis, std::span<const BlockWeight> blocks, double share,
                      double half) {
  const int n = n_runs(basis.clusters);
  if (!basis.bounded)
    return basis.runs.n < n ? RunsToAdd{0, false} : RunsToAdd{std::max(1, least_clusters - n)};
  const double wanted = std::ceil(trials_for(share, half) * (1 - 1e-12));
  const double trials = trials_of(basis, blocks, share);
  double factor = wanted / trials;
  if (basis.clusters.kind == Clusters::Kind::release_cell && factor > 1) {
    const double binomial = share * (1 - share), variance = binomial / trials;
    const double within = std::min(variance, variance_within(basis, blocks, share));
    const double left = binomial / wanted - (variance - within);  // for the part within
    if (!(left > 0)) return {0, false};
    factor = within / left;
  }
  return {static_cast<int>(std::clamp(std::ceil(n * factor * (1 - 1e-12)) - n, 0.0, 1e9)), true};
}

}  // namespace talus
