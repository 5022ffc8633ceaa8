#include "post/share_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double rounding = 1e-24;  // of squares of weights: what is smaller is no variance
constexpr double whole_run = 1 - 1e-12;

// A share of blocks is at most that of the runs with any, and at least that of the runs with all.
Interval within_runs(const Interval& interval, const ShareBasis& basis,
                     std::span<const RunShare> some) {
  double any = 0, all = 0;
  for (const RunShare& run : some) {
    any += run.whole;
    if (run.part >= run.whole * whole_run) all += run.whole;
  }
  const auto of_runs = [&](double weight) {
    return wilson_interval(std::min(1.0, weight / basis.over.whole), basis.n_eff);
  };
  Interval out = interval;
  if (static_cast<int>(some.size()) < basis.over.n_runs)
    out.high = std::min(out.high, of_runs(any).high);
  if (all > 0) out.low = std::max(out.low, of_runs(all).low);
  return out;
}

// The runs with any part.
std::vector<RunShare> shares_of(const ShareBasis& basis, std::span<const RunWeight> parts) {
  std::vector<RunShare> some;
  some.reserve(parts.size());
  for (const RunWeight& part : parts)
    if (part.weight > 0) some.push_back({part.weight, basis.released[part.run]});
  return some;
}

}  // namespace

ShareSample share_sample(const ShareOver& over, std::span<const RunShare> some, double share) {
  const double n = over.n_runs;
  double squares = 0, squares_of_some = 0;
  int n_all = 0;
  for (const RunShare& run : some) {
    const double off = run.part - share * run.whole;
    squares += off * off;
    squares_of_some += run.whole * run.whole;
    n_all += run.part >= run.whole * whole_run;
  }
  const int n_some = static_cast<int>(some.size());
  if (n_some < over.n_runs)
    squares += share * share * std::max(0.0, over.squares - squares_of_some);
  if (over.n_runs < 2 || squares <= rounding * over.squares)
    return {effective_size(over.whole, over.squares), 0};
  const double variance = n / (n - 1) * squares / (over.whole * over.whole);
  return {share * (1 - share) / variance, std::max(1, std::min(n_some, over.n_runs - n_all))};
}

Interval sample_interval(const ShareSample& sample, double share, double p) {
  const double z = normal_quantile(p);
  double n = sample.n_trials;
  if (sample.degrees > 0) n *= std::pow(z / student_quantile(sample.degrees, p), 2);
  return wilson_interval(share, n, z);
}

ShareBasis share_basis(std::span<const double> released, bool single_blocks, double failed_share) {
  ShareBasis basis;
  basis.released.assign(released.begin(), released.end());
  basis.single_blocks = single_blocks;
  basis.over.n_runs = static_cast<int>(released.size());
  basis.bounded = single_blocks || basis.over.n_runs >= least_runs_to_resample;
  for (const double weight : released) {
    basis.over.whole += weight;
    basis.over.squares += weight * weight;
  }
  basis.n_eff = effective_size(basis.over.whole, basis.over.squares);
  basis.failed_share = failed_share;
  weigh_runs_of(basis, std::vector<double>(released.size(), 1.0));
  return basis;
}

void weigh_runs_of(ShareBasis& basis, std::span<const double> run_weight) {
  basis.runs = {static_cast<int>(run_weight.size()), 0, 0};
  for (const double weight : run_weight) {
    basis.runs.whole += weight;
    basis.runs.squares += weight * weight;
  }
}

Interval share_interval(const ShareBasis& basis, std::span<const RunWeight> parts, double share) {
  if (!basis.bounded) return {none, none};
  if (basis.single_blocks)
    return with_failed(wilson_interval(share, basis.n_eff), basis.failed_share);
  const std::vector<RunShare> some = shares_of(basis, parts);
  const Interval interval = sample_interval(share_sample(basis.over, some, share), share);
  return with_failed(within_runs(interval, basis, some), basis.failed_share);
}

double trials_of(const ShareBasis& basis, std::span<const RunWeight> parts, double share) {
  if (!basis.bounded) return none;
  if (basis.single_blocks) return basis.n_eff;
  return share_sample(basis.over, shares_of(basis, parts), share).n_trials;
}

Interval interval_of_none_or_all(const ShareBasis& basis, bool all) {
  if (!basis.bounded) return {none, none};
  return with_failed(wilson_interval(all ? 1 : 0, basis.n_eff), basis.failed_share);
}

Interval run_share_interval(const ShareBasis& basis, double share) {
  return with_failed(wilson_interval(share, effective_size(basis.runs.whole, basis.runs.squares)),
                     basis.failed_share);
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

int runs_to_add(int n_runs, double n_trials, double share, double half) {
  const double trials = std::ceil(trials_for(share, half) * (1 - 1e-12));
  const double wanted = std::ceil(n_runs * trials / n_trials * (1 - 1e-12));
  return static_cast<int>(std::clamp(wanted - n_runs, 0.0, 1e9));
}

}  // namespace talus
