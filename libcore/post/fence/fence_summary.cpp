// Statistics of arrivals at a fence, at one of its fields or at one of its posts.
#include "post/fence/fence_summary.hpp"

#include <algorithm>
#include <set>

#include "base/numbers.hpp"
#include "post/percentile_bounds.hpp"

namespace talus {
namespace {

QuantitySummary summary_of(const std::vector<FenceArrival>& arrivals, double n_eff,
                           PercentileBounds& bounds, double (*quantity)(const FenceArrival&)) {
  std::vector<const FenceArrival*> ascending;
  for (const FenceArrival& a : arrivals) ascending.push_back(&a);
  std::sort(ascending.begin(), ascending.end(),
            [quantity](const FenceArrival* a, const FenceArrival* b) {
              const double x = quantity(*a), y = quantity(*b);
              return x != y ? x < y : a->weight < b->weight;
            });
  std::vector<WeightedValue> values;
  std::vector<BlockWeight> blocks;
  for (const FenceArrival* a : ascending) {
    values.push_back({quantity(*a), a->weight});
    blocks.push_back({a->run, a->block, a->weight});
  }
  QuantitySummary summary;
  summary.largest = values.empty() ? no_value : values.back().value;
  const BoundPlaces upper = upper_bound_places(bounds, blocks);
  for (std::size_t k = 0; k < percentile_levels.size(); ++k) {
    const double p = percentile_levels[k].p;
    BoundedPercentile& out = summary.percentile[k];
    out = {no_value, no_value};
    if (!is_enough(n_eff, p)) continue;
    out.value = weighted_percentile(values, p);
    if (upper[k] >= 0) out.upper = values[upper[k]].value;
  }
  return summary;
}

// Largest sum of energies within a second, of one run or of a rock that fell alone.
void find_busiest_second(const std::vector<FenceArrival>& of_run, FencePartSummary& summary) {
  double sum = 0;
  std::size_t first = 0;
  for (std::size_t last = 0; last < of_run.size(); ++last) {
    sum += of_run[last].energy();
    while (of_run[last].time - of_run[first].time > 1) sum -= of_run[first++].energy();
    if (sum <= summary.window_energy) continue;
    summary.window_energy = sum;
    summary.window_hits = static_cast<int>(last - first + 1);
  }
}

}  // namespace

FencePartSummary summarise(const std::vector<FenceArrival>& given, const Clusters& clusters) {
  FencePartSummary summary;
  std::vector<FenceArrival> sorted = given;
  std::sort(sorted.begin(), sorted.end(), [](const FenceArrival& a, const FenceArrival& b) {
    if (a.run != b.run) return a.run < b.run;
    if (a.world != b.world) return a.world < b.world;
    return a.time != b.time ? a.time < b.time : a.block < b.block;
  });
  double w = 0, w_sq = 0, angle = 0;
  for (const FenceArrival& a : sorted) {
    w += a.weight;
    w_sq += a.weight * a.weight;
    angle += a.weight * a.angle;
  }
  summary.n = static_cast<int>(sorted.size());
  summary.per_run = static_cast<double>(summary.n) / n_runs(clusters);
  summary.n_eff = effective_size(w, w_sq);
  summary.mean_angle = angle / w;
  std::set<int> twice;  // runs
  for (std::size_t i = 0; i < sorted.size();) {
    std::vector<FenceArrival> of_world;
    for (const FenceArrival& first = sorted[i];
         i < sorted.size() && sorted[i].run == first.run && sorted[i].world == first.world; ++i)
      of_world.push_back(sorted[i]);
    if (of_world.size() > 1) twice.insert(of_world[0].run);
    summary.most_in_a_run = std::max(summary.most_in_a_run, static_cast<int>(of_world.size()));
    find_busiest_second(of_world, summary);
  }
  summary.runs_hit_twice = static_cast<double>(twice.size()) / n_runs(clusters);
  PercentileBounds bounds{clusters, fence_resamples};
  const auto of = [&](double (*quantity)(const FenceArrival&)) {
    return summary_of(sorted, summary.n_eff, bounds, quantity);
  };
  summary.energy = of([](const FenceArrival& a) { return a.energy(); });
  summary.translation = of([](const FenceArrival& a) { return a.translation; });
  summary.top = of([](const FenceArrival& a) { return a.top; });
  summary.speed = of([](const FenceArrival& a) { return a.speed; });
  return summary;
}

}  // namespace talus
