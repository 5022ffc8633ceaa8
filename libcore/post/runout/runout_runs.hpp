// libcore/post/runout/runout_runs.hpp: public
// How far many runs came: what is kept of each, their sums and the spread over them.
// in:    run files one by one, the terrain
// out:   of each run its reach, balance, paths and footprints; of all the deposit and swept cells
#pragma once

#include <cstdint>
#include <vector>

#include "post/run_set.hpp"
#include "post/runout/runout.hpp"
#include "post/runout/tree_summary.hpp"

namespace talus {

/// What is kept of a run once it has been read.
struct RunoutRun {
  RunMember member;
  EventReach event;
  Balance balance;
  EnergyShares energy;
  std::vector<TimedPath> paths;               ///< simplified                        (n_blocks)
  std::vector<std::vector<Vec2>> footprints;  ///< at the end, local [m]             (n_blocks)
  std::vector<Vec3> end;                      ///< centroids, local [m]              (n_blocks)
  std::vector<double> volume;                 ///< [m3]                              (n_blocks)
  std::vector<double> mass;                   ///< [kg]                              (n_blocks)
  std::vector<double> displacement;           ///< [m]                               (n_blocks)
  RunTrees trees;
  std::vector<CurveRow> curves;
  std::vector<std::uint32_t> cells;  ///< that any block passed, ascending
  DepositSums deposit;
};
/// `grid` of the deposit.
[[nodiscard]] RunoutRun runout_run(const RunFile& run, const RunMember& member,
                                   const PassageGrid& grid, const Trn& trn,
                                   const ReachSettings& settings);

/// All runs, in the order of their ids, with their sums.
struct RunoutRuns {
  std::vector<RunoutRun> runs;
  Balance balance;
  std::vector<std::uint32_t> cells;  ///< that any block of any run passed, ascending
  DepositSums deposit;
  Released released;
  Moved moved;       ///< the mass of all runs together
  PassageGrid grid;  ///< of cells and deposit
};
[[nodiscard]] RunoutRuns add_up(std::vector<RunoutRun> runs, const PassageGrid& grid);

/// Area of all cells that any block of any run passed [m2].
[[nodiscard]] double swept_area(const RunoutRuns& all);

/// A number over the runs where it is finite; n 0: nowhere, and the rest says nothing.
struct Spread {
  std::size_t n = 0;
  double mean = 0, smallest = 0, p05 = 0, p50 = 0, p95 = 0, largest = 0;
};
[[nodiscard]] Spread spread_over(const std::vector<RunoutRun>& runs,
                                 double (*value)(const RunoutRun&));

/// Runs in which a block moved: the others have no run-out.
[[nodiscard]] int n_moved(const std::vector<RunoutRun>& runs);

/// The run whose event came farthest along the path, the first of them; null when none moved.
[[nodiscard]] const RunoutRun* farthest_run(const std::vector<RunoutRun>& runs);

}  // namespace talus
