#include "post/fence_result.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "post/statistics.hpp"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double degrees = 180 / std::numbers::pi;

std::vector<FenceArrival> only(const std::vector<FenceArrival>& list, int FenceArrival::*member,
                               int value) {
  std::vector<FenceArrival> out;
  for (const FenceArrival& a : list)
    if (a.*member == value) out.push_back(a);
  return out;
}

// Rock behind the line of a fence, a run [m3].
double volume_behind(const FenceRunGroup& group, std::size_t fence) {
  double volume = 0;
  for (const FenceRun& run : group.runs)
    for (const FenceArrival& crossing : passed_for_good(run.at_fence[fence]))
      volume += crossing.volume;
  return volume / n_runs(group);
}

// Rock volume that the fence would hold, a run, in the run where it is largest [m3].
double retained_volume(const FenceRunGroup& group, std::size_t fence) {
  double largest = 0;
  for (const FenceRun& run : group.runs) {
    double volume = 0;
    for (const BlockVerdict& v : run.at_fence[fence].verdicts)
      if (v.verdict == Verdict::stopped) volume += run.volume[v.block];
    largest = std::max(largest, volume);
  }
  return largest;
}

// What is given, and what the released blocks say of the rest.
DesignInput design_input(const DesignInput& given, const FenceRunGroup& group) {
  DesignInput input = given;
  for (const FenceRun& run : group.runs) input.mean_block_size += run.block_size / n_runs(group);
  input.density = group.runs[0].density;
  if (std::isnan(input.block_volume)) {
    std::vector<WeightedValue> volumes;
    for (const FenceRun& run : group.runs)
      for (std::size_t b = 0; b < run.volume.size(); ++b)
        volumes.push_back({run.volume[b], run.weight[b]});
    sort_values(volumes);
    input.block_volume = weighted_percentile(volumes, 0.95);
  }
  return input;
}

}  // namespace

FenceResult fence_result(const FenceCase& fence_case, std::size_t index, const FenceRuns& runs,
                         const DesignCode& code, const std::vector<BarrierClass>& classes,
                         const FenceResultSettings& settings, const Trn& trn) {
  const FenceRunGroup& group = runs.with;
  const Fence& fence = fence_case.fence;
  FenceResult r;
  int towards_left = 0;
  for (const FenceArrival& a : arrivals_at(group, index)) {
    if (a.beside) continue;
    r.arrivals.push_back(a);
    towards_left += a.direction;
  }
  r.side = towards_left != 0 ? (towards_left > 0 ? -1 : 1) : uphill_side(fence, trn);
  const DesignInput input = design_input(settings.design, group);
  const auto summary = [&](const std::vector<FenceArrival>& arrivals) {
    return summarise(arrivals, n_runs(group), settings.seed);
  };
  r.whole = summary(r.arrivals);
  r.design = check_design(code, classes, input, r.whole, fence);
  const double reach = 50 * fence.height;
  for (int f = 0; f < n_fields(fence); ++f) {
    FieldResult field;
    field.part = summary(only(r.arrivals, &FenceArrival::field, f));
    field.design = check_design(code, classes, input, field.part, fence);
    field.storage = storage(fence, f, r.side, trn, reach);
    r.storage += field.storage;
    r.fields.push_back(std::move(field));
  }
  for (int p = 0; p <= n_fields(fence); ++p)
    r.posts.push_back(summary(only(r.arrivals, &FenceArrival::post, p)));
  r.retained = settings.bulking * retained_volume(group, index);
  r.kept =
      n_runs(runs.without) > 0
          ? settings.bulking * (volume_behind(runs.without, index) - volume_behind(group, index))
          : none;
  return r;
}

ShareBasis verdict_basis(const FenceRunGroup& group, std::uint64_t seed) {
  std::vector<double> released;
  bool single_blocks = true;
  for (const FenceRun& run : group.runs) {
    double weight = 0;
    for (const double w : run.weight) weight += w;
    released.push_back(weight);
    single_blocks = single_blocks && run.weight.size() <= 1;
  }
  return share_basis(released, single_blocks, fence_resamples, seed);
}

VerdictShare verdict_share(const FenceRunGroup& group, std::size_t fence, Verdict verdict,
                           const ShareBasis& basis) {
  VerdictShare out;
  std::vector<RunWeight> parts;
  int n_all = 0;
  double weight = 0, total = 0;
  for (int r = 0; r < n_runs(group); ++r) {
    const FenceRun& run = group.runs[r];
    RunWeight part{r, 0};
    double of_run = 0;
    for (const BlockVerdict& v : run.at_fence[fence].verdicts) {
      ++n_all;
      of_run += run.weight[v.block];
      if (v.verdict != verdict) continue;
      ++out.n;
      part.weight += run.weight[v.block];
    }
    parts.push_back(part);
    weight += part.weight;
    total += of_run;
  }
  out.share = weight / total;
  // by counts: sums of weights are rounded
  out.interval = out.n == 0 || out.n == n_all
                     ? interval_of_none_or_all(basis, out.n > 0)
                     : share_interval(basis, parts, std::clamp(out.share, 0.0, 1.0));
  return out;
}

GroundBehind ground_behind(const FenceRunGroup& group, std::size_t fence) {
  GroundBehind out;
  const int n = n_runs(group);
  double weight = 0, weight_sq = 0, total = 0;
  std::vector<WeightedValue> energy;
  for (const FenceRun& run : group.runs) {
    for (const double w : run.weight) total += w;
    for (const FenceArrival& a : passed_for_good(run.at_fence[fence])) {
      weight += a.weight;
      weight_sq += a.weight * a.weight;
      out.volume += a.volume;
      ++out.n;
      energy.push_back({a.energy(), a.weight});
    }
    out.path += run.event.path / n;
    out.path_angle_deg += run.event.path_angle() * degrees / n;
    out.centre_of_mass_path += run.centre.path / n;
  }
  sort_values(energy);
  out.share = weight / total;
  out.volume /= n;
  const bool enough = effective_size(weight, weight_sq) + 1e-9 >= smallest_sample(0.5);
  out.energy_p50 = enough ? weighted_percentile(energy, 0.5) : none;
  out.energy_largest = energy.empty() ? none : energy.back().value;
  return out;
}

}  // namespace talus
