#include "post/share_interval.hpp"

#include <limits>

namespace talus {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

ShareBasis share_basis(std::span<const double> released, bool single_blocks, int n_resamples,
                       std::uint64_t seed) {
  const int n_runs = static_cast<int>(released.size());
  ShareBasis basis;
  basis.single_blocks = single_blocks;
  basis.bounded = single_blocks || n_runs >= least_runs_to_resample;
  double total = 0, total_sq = 0;
  for (const double weight : released) {
    total += weight;
    total_sq += weight * weight;
  }
  basis.n_eff = effective_size(total, total_sq);
  if (!basis.bounded || single_blocks) return basis;
  basis.resamples = resample_runs(n_runs, n_resamples, seed);
  basis.whole = resampled_sums(basis.resamples, released);
  return basis;
}

Interval share_interval(const ShareBasis& basis, std::span<const RunWeight> parts, double share) {
  if (!basis.bounded) return {none, none};
  if (basis.single_blocks) return wilson_interval(share, basis.n_eff);
  return bootstrap_share(parts, basis.whole, basis.resamples);
}

Interval interval_of_none_or_all(const ShareBasis& basis, bool all) {
  if (!basis.bounded) return {none, none};
  return wilson_interval(all ? 1 : 0, basis.n_eff);
}

}  // namespace talus
