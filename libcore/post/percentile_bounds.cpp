#include "post/percentile_bounds.hpp"

#include <algorithm>

namespace talus {
namespace {

constexpr double rounding = 1e-12;

// The values of a sample by run and by weight.
struct RunSample {
  std::vector<double> up_to;   // running sum of the weights, ascending         (n_values)
  std::vector<int> run;        // place among the runs with a value             (n_values)
  std::vector<RunShare> runs;  // `whole` is the weight of a run's values       (n_runs_here)
  ShareOver over;
  double n_eff = 0;
  bool runs_repeat = false;
};

RunSample sample_of(std::span<const RunWeight> ascending, std::vector<int>& place_of_run) {
  RunSample sample;
  sample.up_to.reserve(ascending.size());
  sample.run.reserve(ascending.size());
  double total = 0, total_sq = 0;
  for (const RunWeight& item : ascending) {
    int& place = place_of_run[item.run];
    if (place < 0) {
      place = static_cast<int>(sample.runs.size());
      sample.runs.emplace_back();
    } else {
      sample.runs_repeat = true;
    }
    sample.runs[place].whole += item.weight;
    sample.run.push_back(place);
    sample.up_to.push_back(total += item.weight);
    total_sq += item.weight * item.weight;
  }
  for (const RunWeight& item : ascending) place_of_run[item.run] = -1;
  sample.over = {static_cast<int>(sample.runs.size()), total, 0};
  for (const RunShare& run : sample.runs) sample.over.squares += run.whole * run.whole;
  sample.n_eff = effective_size(total, total_sq);
  return sample;
}

// Of the value that the share p of the weight does not exceed.
int place_of(const RunSample& sample, double p) {
  const double wanted = p * sample.up_to.back() * (1 - rounding);
  const auto at = std::lower_bound(sample.up_to.begin(), sample.up_to.end(), wanted);
  return static_cast<int>(std::min<std::ptrdiff_t>(
      at - sample.up_to.begin(), static_cast<std::ptrdiff_t>(sample.up_to.size()) - 1));
}

// What the share of the values up to the p-percentile rests on.
ShareSample sample_below(RunSample& sample, std::span<const RunWeight> ascending, double p) {
  const int last = place_of(sample, p);
  for (RunShare& run : sample.runs) run.part = 0;
  for (int i = 0; i <= last; ++i) sample.runs[sample.run[i]].part += ascending[i].weight;
  std::vector<RunShare> some;
  for (const RunShare& run : sample.runs)
    if (run.part > 0) some.push_back(run);
  return share_sample(sample.over, some, std::min(1.0, sample.up_to[last] / sample.up_to.back()));
}

int rank_of(PercentileBounds& bounds, std::size_t level, int n) {
  const auto [at, is_new] = bounds.rank[level].try_emplace(n, 0);
  if (is_new) at->second = upper_bound_rank(n, percentile_levels[level].p);
  return at->second;
}

void bootstrap_places(PercentileBounds& bounds, std::span<const RunWeight> ascending,
                      std::size_t n_bounded, BoundPlaces& places) {
  if (!bounds.resamples)
    bounds.resamples = resample_runs(bounds.n_runs, bounds.n_resamples, bounds.seed);
  const std::vector<RunWeight> descending(ascending.rbegin(), ascending.rend());
  std::vector<double> levels;
  for (std::size_t k = n_bounded; k-- > 0;) levels.push_back(percentile_levels[k].p);
  const std::vector<int> found = bootstrap_upper_places(descending, *bounds.resamples, levels);
  for (std::size_t k = 0; k < n_bounded; ++k) {
    const int place = found[n_bounded - 1 - k];
    places[k] = place < 0 ? -1 : static_cast<int>(ascending.size()) - 1 - place;
  }
}

}  // namespace

BoundPlaces upper_bound_places(PercentileBounds& bounds, std::span<const RunWeight> ascending) {
  BoundPlaces places;
  places.fill(-1);
  if (ascending.empty()) return places;
  bounds.place_of_run.resize(static_cast<std::size_t>(bounds.n_runs), -1);
  RunSample sample = sample_of(ascending, bounds.place_of_run);
  const int n = static_cast<int>(sample.n_eff + 1e-9);
  std::size_t n_bounded = 0;  // the lower percentiles need fewer
  while (n_bounded < places.size() && n >= smallest_sample(percentile_levels[n_bounded].p))
    ++n_bounded;
  if (!sample.runs_repeat) {
    for (std::size_t k = 0; k < n_bounded; ++k)
      places[k] = place_of(sample, static_cast<double>(rank_of(bounds, k, n)) / n);
    return places;
  }
  if (sample.over.n_runs < least_runs_to_resample || n_bounded == 0) return places;
  if (sample.over.n_runs < least_runs_for_woodruff) {
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

BoundedPlaces percentile_places(std::span<const RunWeight> ascending, double p) {
  if (ascending.empty()) return {};
  int last_run = 0;
  for (const RunWeight& item : ascending) last_run = std::max(last_run, item.run);
  std::vector<int> place_of_run(static_cast<std::size_t>(last_run) + 1, -1);
  RunSample sample = sample_of(ascending, place_of_run);
  const int n = static_cast<int>(sample.n_eff + 1e-9);
  if (n < smallest_sample(p)) return {};
  BoundedPlaces places{place_of(sample, p), -1, -1};
  if (!sample.runs_repeat) {
    const RankInterval ranks = rank_interval(n, p);
    if (ranks.low > 0) places.low = place_of(sample, static_cast<double>(ranks.low) / n);
    if (ranks.high > 0) places.high = place_of(sample, static_cast<double>(ranks.high) / n);
    return places;
  }
  if (sample.over.n_runs < least_runs_for_woodruff) return places;
  const ShareSample below = sample_below(sample, ascending, p);
  if (below.n_trials + 1e-9 < smallest_sample(p)) return places;
  const Interval interval = sample_interval(below, p);
  places.low = place_of(sample, interval.low);
  places.high = place_of(sample, interval.high);
  return places;
}

}  // namespace talus
