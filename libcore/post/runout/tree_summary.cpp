// Trees that were hit over many runs: stem by stem, and forest by forest.
#include "post/runout/tree_summary.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "record/pieces.hpp"

namespace talus {
namespace {

// Identity of a stem: of stands that each run draws anew, the place too.
using StemName = std::tuple<std::string, std::int32_t, double, double>;

void add_trees(const RunTrees& run, std::map<StemName, HitStem>& stems,
               std::map<std::string, ForestSummary>& forests) {
  for (const ForestInfo& forest : run.forests) {
    ForestSummary& sum = forests[forest.name];
    const int n_worlds = run.independent ? count_different(run.worlds) : 1;
    sum.name = forest.name;
    ++sum.n_runs;
    sum.n_worlds += n_worlds;
    sum.stems += static_cast<double>(forest.n_stems) * n_worlds;
  }
  std::set<StemName> seen;  // in this run so far
  std::set<std::pair<int, StemName>> met;
  for (const TreeHitRow& row : run.hits) {
    const std::string& name = run.forests[row.forest].name;
    const StemName key(name, row.stem, row.foot.x(), row.foot.y());
    const int world = run.independent ? run.worlds[static_cast<std::size_t>(row.hit.block)] : 0;
    HitStem& stem = stems[key];
    if (stem.n_hits == 0) {
      stem.forest = name;
      stem.first = row;
      stem.least_left = row.left;
    }
    ++stem.n_hits;
    stem.largest_work = std::max(stem.largest_work, row.hit.work);
    stem.least_left = std::min(stem.least_left, row.left);
    ForestSummary& sum = forests[name];
    sum.work += row.hit.work;
    stem.n_runs += seen.insert(key).second;
    if (!met.emplace(world, key).second) continue;
    sum.hit += 1;
    if (row.broken_by < 0) continue;
    ++stem.n_broken;
    sum.broken += 1;
  }
}

}  // namespace

RunTrees trees_of(const RunFile& run) {
  return {run.forests, run.tree_hits, worlds_of(run), run.info.independent};
}

TreeSummary summary_of(const std::vector<RunTrees>& runs) {
  std::map<StemName, HitStem> stems;
  std::map<std::string, ForestSummary> forests;
  for (const RunTrees& run : runs) add_trees(run, stems, forests);
  TreeSummary out;
  for (auto& [key, stem] : stems) out.stems.push_back(std::move(stem));
  for (auto& [name, sum] : forests) {
    for (double* value : {&sum.stems, &sum.hit, &sum.broken, &sum.work}) *value /= sum.n_worlds;
    out.forests.push_back(sum);
  }
  return out;
}

}  // namespace talus
