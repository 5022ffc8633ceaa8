// libcore/post/runout/tree_summary.hpp: public
// Which trees were hit over many runs: stem by stem, and forest by forest.
// in:    hits of trees of run files
// out:   how often each stem was hit and broken, and its residual strength
#pragma once

#include <string>
#include <vector>

#include "record/run_file.hpp"

namespace talus {

/// The hits of one run, and its forests.
struct RunTrees {
  std::vector<ForestInfo> forests;
  std::vector<TreeHitRow> hits;
  std::vector<int> worlds;  ///< of each block (worlds_of): those of one meet the same trees
  bool independent = false;
};
[[nodiscard]] RunTrees trees_of(const RunFile& run);

/// A stem that was hit in some run. Stems of two runs are one where forest, id and place agree.
struct HitStem {
  std::string forest;
  TreeHitRow first;         ///< its first hit in the first run that hit it
  int n_runs = 0;           ///< that hit it
  int n_hits = 0;           ///< blocks that touched it, over all runs
  int n_broken = 0;         ///< runs in which it broke; rocks that broke it, where each met its own
  double largest_work = 0;  ///< that one block lost to it [J]
  double least_left = 0;    ///< of its capacity at the end of a run [J]
};

/// A forest over the runs that had it.
struct ForestSummary {
  std::string name;
  int n_runs = 0;                         ///< that had it
  int n_worlds = 0;                       ///< these, or the rocks that each met the whole forest
  double stems = 0, hit = 0, broken = 0;  ///< mean over these runs or rocks
  double work = 0;                        ///< energy taken, mean over them [J]
};

struct TreeSummary {
  std::vector<HitStem> stems;          ///< by forest, then id
  std::vector<ForestSummary> forests;  ///< by name
};
[[nodiscard]] TreeSummary summary_of(const std::vector<RunTrees>& runs);

}  // namespace talus
