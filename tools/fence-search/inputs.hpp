// tools/fence-search/inputs.hpp
// What talus-fence-search reads: runs that watched the candidate lines, and runs with a
// proposed fence.
#pragma once

#include <string>
#include <vector>

#include "post/fence_search/paths.hpp"
#include "post/hazard/hazard_rates.hpp"
#include "setup/search_lines.hpp"
#include "tools/frame/run_inputs.hpp"

namespace talus {

/// One [fence_search.*] with its results from the runs.
struct SearchCase {
  const FenceSearchSettings* settings = nullptr;
  RecordObject object;
  SearchSettings what;  ///< can be built, and its cost
  DesignCode code;
  std::string code_sha256;
  double step = 0;  ///< of the candidates [m]
  std::vector<SearchLine> lines;
  SearchRuns runs;
  double hits_a_run = 0;                       ///< of the object, runs by their weights
  std::vector<HazardRuns> classes;             ///< frequencies; empty: none
  std::vector<std::vector<double>> on_object;  ///< time of the first touch, by run and block [s]
};

/// The searches of a site; `only`: the one of this name, "" all. Throws InputError where there is
/// none, and as search_candidates().
[[nodiscard]] std::vector<SearchCase> search_cases(Tool& tool, const Site& site,
                                                   const std::string& only, const Trn& trn);

/// Reads the runs into all cases. Runs of several classes count by how often their events happen.
/// Warns of fences that were built. Throws InputError for runs that did not watch the lines of a
/// search, or its object.
void read_search_runs(Tool& tool, RunInputs& runs, const Site& site,
                      std::vector<SearchCase>& cases);

/// Hits of an object behind a built fence.
struct VerifiedFence {
  int n_runs = 0;
  double residual = 0;      ///< share of runs with a block on the object
  Interval interval;        ///< 95 %
  double hits_a_run = 0;    ///< runs by their weights
  double weight_a_run = 0;  ///< of the blocks that hit
};
/// Reads runs in which `fences` were built, by their names; of several classes those of class C are
/// of case C. Throws InputError where the fences were not built there, for runs that are
/// among those of the search or have the seed of one, and for runs without a class.
[[nodiscard]] VerifiedFence read_verified(RunInputs& runs, const std::string& name,
                                          const std::vector<std::string>& paths,
                                          const std::vector<Fence>& fences,
                                          const SearchCase& search);

}  // namespace talus
