// Results of one fence over many runs: verdicts, statistics, design check, ground behind it.
#include "post/fence/fence_result.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "post/statistics.hpp"
#include "record/pieces.hpp"

namespace talus {
namespace {

std::vector<FenceArrival> only(const std::vector<FenceArrival>& list, int FenceArrival::*member,
                               int value) {
  std::vector<FenceArrival> out;
  for (const FenceArrival& a : list)
    if (a.*member == value) out.push_back(a);
  return out;
}

// Rock behind the line of a fence, a run; of rocks that fell one by one, a rock [m3].
double volume_behind(const FenceRunGroup& group, std::size_t fence) {
  double volume = 0;
  for (const FenceRun& run : group.runs)
    for (const FenceArrival& crossing : passed_for_good(run.at_fence[fence]))
      volume += run.run_weight * crossing.volume / count_different(run.world);
  return volume / weight_of_runs(group);
}

// Rock volume that the fence would hold at once, in the run, or of the rock, where it is largest
// [m3].
double retained_volume(const FenceRunGroup& group, std::size_t fence) {
  double largest = 0;
  for (const FenceRun& run : group.runs) {
    std::map<int, double> volume;  // by world
    for (const BlockVerdict& v : run.at_fence[fence].verdicts)
      if (v.verdict == Verdict::stopped)
        largest = std::max(largest, volume[run.world[v.block]] += run.volume[v.block]);
  }
  return largest;
}

// Arrivals at the line itself, not beside it.
std::vector<FenceArrival> arrivals_on_line(const FenceRunGroup& group, std::size_t fence) {
  std::vector<FenceArrival> out;
  for (const FenceArrival& a : arrivals_at(group, fence))
    if (!a.beside) out.push_back(a);
  return out;
}

// The given values; the rest is taken from the blocks.
DesignInput design_input(const DesignInput& given, const FenceRunGroup& group,
                         const std::vector<FenceArrival>& arrivals) {
  DesignInput input = given;
  for (const FenceRun& run : group.runs)
    input.mean_block_size += run.run_weight * run.block_size / weight_of_runs(group);
  input.density = group.runs[0].density;
  if (std::isnan(input.block_volume))
    set_design_block(input, arrivals);
  else
    input.block_source = "given (--design-block-m3)";
  return input;
}

DesignBasis basis_of(const FenceRuns& runs, std::size_t index) {
  if (!stood(runs.with, index)) return DesignBasis::open_line;
  return n_runs(runs.without) > 0 && !stood(runs.without, index) ? DesignBasis::without_fence
                                                                 : DesignBasis::first_touches;
}

}  // namespace

void set_design_block(DesignInput& input, const std::vector<FenceArrival>& arrivals) {
  constexpr double level = 0.95;
  std::vector<WeightedValue> volumes;
  double weight = 0, weight_sq = 0;
  for (const FenceArrival& a : arrivals) {
    volumes.push_back({a.volume, a.weight});
    weight += a.weight;
    weight_sq += a.weight * a.weight;
  }
  if (volumes.empty()) return;
  sort_values(volumes);
  const std::string n = counted(static_cast<std::int64_t>(arrivals.size()), "block");
  const std::string arrive = arrivals.size() == 1 ? " that arrives" : " that arrive";
  if (is_enough(effective_size(weight, weight_sq), level)) {
    input.block_volume = weighted_percentile(volumes, level);
    input.block_source = "95th percentile of the " + n + arrive;
    return;
  }
  input.block_volume = volumes.back().value;
  input.block_source = "largest of the " + n + arrive + "; the 95th percentile needs " +
                       std::to_string(smallest_sample(level));
}

FenceResult fence_result(const FenceCase& fence_case, std::size_t index, const FenceRuns& runs,
                         const DesignCode& code, const std::vector<BarrierClass>& classes,
                         const FenceResultSettings& settings, const Trn& trn) {
  const FenceRunGroup& group = runs.with;
  const Fence& fence = fence_case.fence;
  FenceResult r;
  int towards_left = 0;
  r.arrivals = arrivals_on_line(group, index);
  for (const FenceArrival& a : r.arrivals) towards_left += a.direction;
  r.side = towards_left != 0 ? (towards_left > 0 ? -1 : 1) : uphill_side(fence, trn);
  r.basis = basis_of(runs, index);
  const FenceRunGroup& design_group =
      r.basis == DesignBasis::without_fence ? runs.without : runs.with;
  r.n_basis_runs = n_runs(design_group);
  const std::vector<FenceArrival> design_arrivals = arrivals_on_line(design_group, index);
  DesignInput input = design_input(settings.design, group, design_arrivals);
  input.first_touches = r.basis == DesignBasis::first_touches;
  const auto summary = [&](const std::vector<FenceArrival>& arrivals, const FenceRunGroup& of) {
    return summarise(arrivals, of.clusters);
  };
  r.whole = summary(r.arrivals, group);
  r.at_basis = summary(design_arrivals, design_group);
  r.design = check_design(code, classes, input, r.at_basis, fence);
  const double reach = 50 * fence.height;
  for (int f = 0; f < n_fields(fence); ++f) {
    FieldResult field;
    field.part = summary(only(r.arrivals, &FenceArrival::field, f), group);
    field.design =
        check_design(code, classes, input,
                     summary(only(design_arrivals, &FenceArrival::field, f), design_group), fence);
    field.storage = storage(fence, f, r.side, trn, reach);
    r.storage += field.storage;
    r.fields.push_back(std::move(field));
  }
  for (int p = 0; p <= n_fields(fence); ++p)
    r.posts.push_back(summary(only(r.arrivals, &FenceArrival::post, p), group));
  r.retained = settings.bulking * retained_volume(group, index);
  r.kept =
      n_runs(runs.without) > 0
          ? settings.bulking * (volume_behind(runs.without, index) - volume_behind(group, index))
          : no_value;
  return r;
}

VerdictShare verdict_share(const FenceRunGroup& group, std::size_t fence, Verdict verdict,
                           const ShareBasis& basis) {
  VerdictShare out;
  std::vector<BlockWeight> blocks;
  int n_all = 0;
  double weight = 0, total = 0;
  for (int r = 0; r < n_runs(group); ++r) {
    const FenceRun& run = group.runs[r];
    for (const BlockVerdict& v : run.at_fence[fence].verdicts) {
      ++n_all;
      total += run.weight[v.block];
      if (v.verdict != verdict) continue;
      ++out.n;
      blocks.push_back({r, v.block, run.weight[v.block]});
      weight += run.weight[v.block];
    }
  }
  out.share = weight / total;
  // by counts: sums of weights are rounded
  out.interval = out.n == 0 || out.n == n_all
                     ? interval_of_none_or_all(basis, out.n > 0)
                     : share_interval(basis, blocks, std::clamp(out.share, 0.0, 1.0));
  return out;
}

GroundBehind ground_behind(const FenceRunGroup& group, std::size_t fence) {
  GroundBehind out;
  double weight = 0, weight_sq = 0, total = 0, weight_moved = 0;
  std::vector<WeightedValue> energy;
  for (const FenceRun& run : group.runs) {
    for (const double w : run.weight) total += w;
    for (const FenceArrival& a : passed_for_good(run.at_fence[fence])) {
      weight += a.weight;
      weight_sq += a.weight * a.weight;
      out.volume += run.run_weight * a.volume;
      ++out.n;
      energy.push_back({a.energy(), a.weight});
    }
    if (std::isnan(run.event.path)) continue;
    ++out.n_moved;
    weight_moved += run.run_weight;
    out.path += run.run_weight * run.event.path;
    out.path_angle_deg += run.run_weight * run.event.path_angle() / degree;
    out.centre_of_mass_path += run.run_weight * run.centre.path;
  }
  for (double* sum : {&out.path, &out.path_angle_deg, &out.centre_of_mass_path})
    *sum = out.n_moved > 0 ? *sum / weight_moved : no_value;
  sort_values(energy);
  out.share = weight / total;
  out.volume /= weight_of_runs(group);
  const bool enough = is_enough(effective_size(weight, weight_sq), 0.5);
  out.energy_p50 = enough ? weighted_percentile(energy, 0.5) : no_value;
  out.energy_largest = energy.empty() ? no_value : energy.back().value;
  return out;
}

}  // namespace talus
