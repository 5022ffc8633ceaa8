// Difference of the runs of a variant from the site's runs of the same seeds, with its interval.
#include "post/paired.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/numbers.hpp"

namespace talus {
namespace {

constexpr double rounding = 1e-9;  // of sums of amounts: less is no difference

using RunKey = std::pair<std::string, std::int64_t>;  // case, seed

std::map<RunKey, int> by_seed(std::span<const RunMember> runs) {
  std::map<RunKey, int> out;
  for (std::size_t r = 0; r < runs.size(); ++r)
    out.try_emplace({runs[r].info.case_name, runs[r].info.seed}, static_cast<int>(r));
  return out;
}

// Pairs by release cell, of the runs that both have.
void pair_cells(RunPairs& pairs, std::span<const RunMember> site,
                std::span<const RunMember> variant) {
  std::map<int, int> number;  // of a cell
  const auto number_of = [&number](int cell) {
    return number.try_emplace(cell, static_cast<int>(number.size())).first->second;
  };
  const auto add = [&](RunPairs::Side& side, std::span<const RunMember> runs) {
    side.of_block.resize(runs.size());
    for (std::size_t r = 0; r < runs.size(); ++r)
      if (side.of_run[r] >= 0)
        for (const int cell : runs[r].release_cell) side.of_block[r].push_back(number_of(cell));
  };
  add(pairs.site, site);
  add(pairs.variant, variant);
  pairs.n_pairs = static_cast<int>(number.size());
}

// Where some runs have no pair, each case keeps its share of the whole; a case without any loses
// it.
void keep_case_shares(RunPairs::Side& side, std::span<const RunMember> runs, double n_paired) {
  side.factor.assign(runs.size(), 1);
  if (n_paired == static_cast<double>(runs.size())) return;
  struct Count {
    double all = 0, paired = 0;
  };
  std::map<std::string, Count> cases;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Count& of = cases[runs[r].info.case_name];
    ++of.all;
    of.paired += side.of_run[r] >= 0;
  }
  double sum = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (side.of_run[r] < 0) continue;
    const Count& of = cases[runs[r].info.case_name];
    side.factor[r] = of.all / of.paired;
    sum += side.factor[r] * runs[r].run_weight;
  }
  for (double& factor : side.factor) factor *= n_paired / sum;
}

int pair_of(const RunPairs::Side& side, const BlockWeight& block) {
  const auto run = static_cast<std::size_t>(block.run);
  if (side.of_run[run] < 0 || side.of_block.empty()) return side.of_run[run];
  return side.of_block[run][static_cast<std::size_t>(block.block)];
}

}  // namespace

RunPairs pairs_of(std::span<const RunMember> site, std::span<const RunMember> variant) {
  RunPairs pairs;
  pairs.site.of_run.assign(site.size(), -1);
  pairs.variant.of_run.assign(variant.size(), -1);
  const Clusters of_site = clusters_of(site), of_variant = clusters_of(variant);
  const std::map<RunKey, int> there = by_seed(variant);
  std::map<int, int> number;  // of a cluster of runs
  for (const auto& [key, run] : by_seed(site)) {
    const auto at = there.find(key);
    if (at == there.end()) continue;
    ++pairs.n_runs;
    const int cluster = of_site.of_run.empty() ? run : of_site.of_run[run];
    pairs.site.of_run[run] = pairs.variant.of_run[at->second] =
        number.try_emplace(cluster, static_cast<int>(number.size())).first->second;
  }
  pairs.n_pairs = static_cast<int>(number.size());
  keep_case_shares(pairs.site, site, pairs.n_runs);
  keep_case_shares(pairs.variant, variant, pairs.n_runs);
  if (of_site.kind == Clusters::Kind::release_cell && of_variant.kind == of_site.kind)
    pair_cells(pairs, site, variant);
  return pairs;
}

PairedDifference paired_difference(const RunPairs& pairs, std::span<const BlockWeight> site,
                                   std::span<const BlockWeight> variant, const AmountCurve& curve) {
  PairedDifference out;
  struct Amount {
    int pair;
    bool is_of_variant;
    double value;
    auto operator<=>(const Amount&) const = default;
  };
  std::vector<Amount> amounts;
  const auto add = [&](const RunPairs::Side& side, std::span<const BlockWeight> blocks,
                       bool is_of_variant, double& sum) {
    for (const BlockWeight& block : blocks) {
      const int pair = pair_of(side, block);
      if (pair < 0) continue;
      const double amount = side.factor[static_cast<std::size_t>(block.run)] * block.weight;
      sum += amount;
      amounts.push_back({pair, is_of_variant, amount});
    }
  };
  add(pairs.site, site, false, out.site);
  add(pairs.variant, variant, true, out.variant);
  const double n_runs = pairs.n_runs, n = pairs.n_pairs;
  const double slope_of_site = curve.slope(out.site / n_runs),
               slope_of_variant = curve.slope(out.variant / n_runs);
  std::sort(amounts.begin(), amounts.end());
  std::vector<double> difference;  // of pairs with any amount
  double largest = 0;              // of their amounts
  for (std::size_t i = 0; i < amounts.size();) {
    double of_site = 0, of_variant = 0;
    for (const int pair = amounts[i].pair; i < amounts.size() && amounts[i].pair == pair; ++i)
      (amounts[i].is_of_variant ? of_variant : of_site) += amounts[i].value;
    out.n_differ +=
        std::abs(of_variant - of_site) > rounding * (std::abs(of_site) + std::abs(of_variant));
    difference.push_back(slope_of_variant * of_variant - slope_of_site * of_site);
    largest = std::fmax(largest, slope_of_variant * of_variant + slope_of_site * of_site);
  }
  out.site = curve.value(out.site / n_runs);
  out.variant = curve.value(out.variant / n_runs);
  out.value = out.n_differ > 0 ? out.variant - out.site : 0;
  out.interval = {no_value, no_value};
  if (pairs.n_pairs < least_clusters || out.n_differ < 2) return out;
  double mean = 0;
  for (const double d : difference) mean += d / n;
  double squares = (n - static_cast<double>(difference.size())) * mean * mean;
  for (const double d : difference) squares += (d - mean) * (d - mean);
  // differences that are all alike say nothing of their scatter
  if (squares <= n * rounding * rounding * largest * largest) return out;
  const double half =
      student_quantile(out.n_differ - 1, 0.975) * std::sqrt(squares / (n - 1) * n) / n_runs;
  out.interval = {out.value - half, out.value + half};
  return out;
}

}  // namespace talus
