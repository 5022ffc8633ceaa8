// Groups the blocks of a set of runs into independent clusters.
#include "ensemble/clusters.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "base/text.hpp"

namespace talus {
namespace {

// Whether other runs are no more than other rocks.
bool are_of_cells(std::span<const RunMember> runs) {
  return std::all_of(runs.begin(), runs.end(), [](const RunMember& run) {
    return run.info.independent && !run.draws_for_all &&
           run.release_cell.size() == static_cast<std::size_t>(run.n_blocks);
  });
}

Clusters over_runs(std::span<const RunMember> runs) {
  Clusters out;
  out.of_run = units_of(runs);
  if (!out.of_run.empty() && !runs.front().info.terrain_digest.empty())
    out.kind = Clusters::Kind::rock_mass;
  if (out.of_run.empty()) {
    out.of_run.resize(runs.size());
    std::iota(out.of_run.begin(), out.of_run.end(), 0);
  }
  const int last =
      out.of_run.empty() ? -1 : *std::max_element(out.of_run.begin(), out.of_run.end());
  out.weight.resize(static_cast<std::size_t>(last) + 1);
  out.n_blocks.resize(out.weight.size());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    out.weight[out.of_run[r]] += runs[r].weight;
    out.n_blocks[out.of_run[r]] += runs[r].n_blocks;
    out.run_weight.push_back(runs[r].run_weight);
  }
  return out;
}

}  // namespace

Clusters clusters_of(std::span<const RunMember> runs) {
  Clusters out = over_runs(runs);
  if (!are_of_cells(runs)) return out;
  std::map<int, int> number;  // of a cell
  for (const RunMember& run : runs)
    for (const int cell : run.release_cell) number.try_emplace(cell, 0);
  if (static_cast<int>(number.size()) < least_clusters) return out;
  int n = 0;
  for (auto& [cell, cluster] : number) cluster = n++;
  out.kind = Clusters::Kind::release_cell;
  out.weight.assign(number.size(), 0);
  out.n_blocks.assign(number.size(), 0);
  for (const RunMember& run : runs) {
    std::vector<int>& of_block = out.of_block.emplace_back();
    of_block.reserve(run.release_cell.size());
    for (std::size_t b = 0; b < run.release_cell.size(); ++b) {
      const int cluster = number[run.release_cell[b]];
      of_block.push_back(cluster);
      out.weight[cluster] += run.run_weight * (run.block_weight.empty() ? 1 : run.block_weight[b]);
      ++out.n_blocks[cluster];
    }
  }
  return out;
}

std::string text(const Clusters& clusters) {
  constexpr const char* names[] = {"run", "rock mass", "release cell"};
  const int n = n_clusters(clusters);
  if (clusters.kind == Clusters::Kind::rock_mass && n != 1)
    return std::to_string(n) + " rock masses";
  return counted(n, names[static_cast<int>(clusters.kind)]);
}

}  // namespace talus
