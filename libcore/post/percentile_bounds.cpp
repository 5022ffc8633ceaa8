// Upper 95 % bounds of percentiles: one rule for maps and fences.
#include "post/percentile_bounds.hpp"

#include <algorithm>

namespace talus {
namespace {

constexpr double rounding = 1e-12;

// The values of a sample by cluster and by weight.
struct ClusterSample {
  std::vector<double> up_to;           // running sum of the weights, ascending     (n_values)
  std::vector<int> cluster;            // place among those with a value            (n_values)
  std::vector<ClusterShare> clusters;  // with a value; `whole`: weight of its values
  ShareOver over;
  double n_eff = 0;
  bool clusters_repeat = false;
};

ClusterSample sample_of(std::span<const ClusterWeight> ascending,
                        std::vector<int>& place_of_cluster) {
  ClusterSample sample;
  sample.up_to.reserve(ascending.size());
  sample.cluster.reserve(ascending.size());
  double total = 0, total_sq = 0;
  for (const ClusterWeight& item : ascending) {
    int& place = place_of_cluster[item.cluster];
    if (place < 0) {
      place = static_cast<int>(sample.clusters.size());
      sample.clusters.emplace_back();
    } else {
      sample.clusters_repeat = true;
    }
    sample.clusters[place].whole += item.weight;
    sample.cluster.push_back(place);
    sample.up_to.push_back(total += item.weight);
    total_sq += item.weight * item.weight;
  }
  for (const ClusterWeight& item : ascending) place_of_cluster[item.cluster] = -1;
  sample.over = {static_cast<int>(sample.clusters.size()), total, 0};
  for (const ClusterShare& one : sample.clusters) sample.over.squares += one.whole * one.whole;
  sample.n_eff = effective_size(total, total_sq);
  return sample;
}

// Of the value that the share p of the weight does not exceed.
int place_of(const ClusterSample& sample, double p) {
  const double wanted = p * sample.up_to.back() * (1 - rounding);
  const auto at = std::lower_bound(sample.up_to.begin(), sample.up_to.end(), wanted);
  return static_cast<int>(std::min<std::ptrdiff_t>(
      at - sample.up_to.begin(), static_cast<std::ptrdiff_t>(sample.up_to.size()) - 1));
}

// Basis of the share of the values up to the p-percentile.
ShareSample sample_below(ClusterSample& sample, std::span<const ClusterWeight> ascending,
                         double p) {
  const int last = place_of(sample, p);
  for (ClusterShare& one : sample.clusters) one.part = 0;
  for (int i = 0; i <= last; ++i) sample.clusters[sample.cluster[i]].part += ascending[i].weight;
  std::vector<ClusterShare> some;
  for (const ClusterShare& one : sample.clusters)
    if (one.part > 0) some.push_back(one);
  return share_sample(sample.over, some, std::min(1.0, sample.up_to[last] / sample.up_to.back()));
}

int rank_of(PercentileBounds& bounds, std::size_t level, int n) {
  const auto [at, is_new] = bounds.rank[level].try_emplace(n, 0);
  if (is_new) at->second = upper_bound_rank(n, percentile_levels[level].p);
  return at->second;
}

void bootstrap_places(PercentileBounds& bounds, std::span<const ClusterWeight> ascending,
                      std::size_t n_bounded, BoundPlaces& places) {
  if (!bounds.resamples)
    bounds.resamples =
        resample_clusters(n_clusters(bounds.clusters), bounds.n_resamples, bounds.seed);
  const std::vector<ClusterWeight> descending(ascending.rbegin(), ascending.rend());
  std::vector<double> levels;
  for (std::size_t k = n_bounded; k-- > 0;) levels.push_back(percentile_levels[k].p);
  const std::vector<int> found = bootstrap_upper_places(descending, *bounds.resamples, levels);
  for (std::size_t k = 0; k < n_bounded; ++k) {
    const int place = found[n_bounded - 1 - k];
    places[k] = place < 0 ? -1 : static_cast<int>(ascending.size()) - 1 - place;
  }
}

std::vector<ClusterWeight> by_cluster(const Clusters& clusters,
                                      std::span<const BlockWeight> blocks) {
  std::vector<ClusterWeight> out;
  out.reserve(blocks.size());
  for (const BlockWeight& block : blocks)
    out.push_back({cluster_of(clusters, block.run, block.block), block.weight});
  return out;
}

}  // namespace

BoundPlaces upper_bound_places(PercentileBounds& bounds, std::span<const BlockWeight> blocks) {
  BoundPlaces places;
  places.fill(-1);
  if (blocks.empty()) return places;
  const std::vector<ClusterWeight> ascending = by_cluster(bounds.clusters, blocks);
  bounds.place_of_cluster.resize(bounds.clusters.weight.size(), -1);
  ClusterSample sample = sample_of(ascending, bounds.place_of_cluster);
  const int n = static_cast<int>(sample.n_eff + 1e-9);
  std::size_t n_bounded = 0;  // the lower percentiles need fewer
  while (n_bounded < places.size() && n >= smallest_sample(percentile_levels[n_bounded].p))
    ++n_bounded;
  if (!sample.clusters_repeat) {
    for (std::size_t k = 0; k < n_bounded; ++k)
      places[k] = place_of(sample, static_cast<double>(rank_of(bounds, k, n)) / n);
    return places;
  }
  if (sample.over.n < least_clusters || n_bounded == 0) return places;
  if (sample.over.n < least_clusters_for_woodruff) {
    bootstrap_places(bounds, ascending, n_bounded, places);
    return places;
  }
  for (std::size_t k = 0; k < n_bounded; ++k) {
    const double p = percentile_levels[k].p;
    const ShareSample below = sample_below(sample, ascending, p);
    if (below.n_trials + 1e-9 < smallest_sample(p)) break;
    places[k] = place_of(sample, sample_interval(below, p, 0.95).high);
  }
  return places;
}

BoundedPlaces percentile_places(PercentileBounds& bounds, std::span<const BlockWeight> blocks,
                                double p) {
  if (blocks.empty()) return {};
  const std::vector<ClusterWeight> ascending = by_cluster(bounds.clusters, blocks);
  bounds.place_of_cluster.resize(bounds.clusters.weight.size(), -1);
  ClusterSample sample = sample_of(ascending, bounds.place_of_cluster);
  const int n = static_cast<int>(sample.n_eff + 1e-9);
  if (n < smallest_sample(p)) return {};
  BoundedPlaces places{place_of(sample, p), -1, -1};
  if (!sample.clusters_repeat) {
    const RankInterval ranks = rank_interval(n, p);
    if (ranks.low > 0) places.low = place_of(sample, static_cast<double>(ranks.low) / n);
    if (ranks.high > 0) places.high = place_of(sample, static_cast<double>(ranks.high) / n);
    return places;
  }
  if (sample.over.n < least_clusters_for_woodruff) return places;
  const ShareSample below = sample_below(sample, ascending, p);
  if (below.n_trials + 1e-9 < smallest_sample(p)) return places;
  const Interval interval = sample_interval(below, p);
  places.low = place_of(sample, interval.low);
  places.high = place_of(sample, interval.high);
  return places;
}

}  // namespace talus
