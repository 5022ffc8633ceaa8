// libcore/post/runout/runout_runs.hpp: public
// How far many runs came: the data kept of each, their sums and the spread over them.
// in:    run files one by one, the terrain
// out:   of each run its reach, balance, paths and footprints; of all the deposit and swept cells
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ensemble/run_set.hpp"
#include "post/runout/runout.hpp"
#include "post/runout/tree_summary.hpp"

namespace talus {

/// A value that a run drew, by the name of its column.
struct DrawnValue {
  std::string name;
  double value = 0;
};

/// Crossings of a line by a run.
struct LineReach {
  std::string name;
  double share = 0;   ///< of the weight of its blocks [-]
  double energy = 0;  ///< largest, with spin; 0: none crossed [J]
};
/// Of each line that the run recorded.
[[nodiscard]] std::vector<LineReach> reach_of_lines(const RunFile& run);

/// Data kept of a run after it was read.
struct RunoutRun {
  RunMember member;
  std::vector<DrawnValue> drawn;  ///< where it is known
  std::vector<LineReach> lines;
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
  std::vector<CurveRow> curves;  ///< of a run without frames: start and end
  bool has_frames = true;        ///< else there are no paths
};
[[nodiscard]] RunoutRun runout_run(const RunFile& run, const RunMember& member, const Trn& trn,
                                   const ReachSettings& settings);

/// All runs, in the order of their ids, with their sums.
struct RunoutRuns {
  std::vector<RunoutRun> runs;
  Balance balance;
  std::vector<std::uint32_t> cells;  ///< that any block of any run passed, ascending
  DepositSums deposit;
  Moved moved;       ///< the mass of all runs together, each with its weight
  PassageGrid grid;  ///< of cells and deposit
};
/// Sums of runs as they are read, in the order of their ids. `grid`: of cells and deposit.
struct RunoutSums {
  PassageGrid grid;
  std::vector<RunoutRun> runs;
  DepositSums deposit;
  std::vector<std::uint8_t> is_passed;  ///< 1: by any block of any run               (n_cells)
};
void add_run(RunoutSums& sums, const RunFile& run, const RunMember& member, const PassageGrid& grid,
             const Trn& trn, const ReachSettings& settings);
void add_cell(RunoutSums& sums, std::int32_t cell);

[[nodiscard]] RunoutRuns add_up(RunoutSums sums);

/// Area of all cells that any block of any run passed [m2].
[[nodiscard]] double swept_area(const RunoutRuns& all);

/// A number over the runs where it is finite; n 0: nowhere, and the rest says nothing.
struct Spread {
  std::size_t n = 0;
  double mean = 0, smallest = 0, p05 = 0, p50 = 0, p95 = 0, largest = 0;
};
[[nodiscard]] Spread spread_over(const std::vector<RunoutRun>& runs,
                                 double (*value)(const RunoutRun&));

/// The runs of one case.
struct RunoutCase {
  std::string name;
  std::vector<int> runs;  ///< of RunoutRuns::runs
  Moved moved;            ///< the mass of its runs together
};
/// By name; empty where all runs are of one case.
[[nodiscard]] std::vector<RunoutCase> cases_of(const std::vector<RunoutRun>& runs);

/// spread_over() of some runs.
[[nodiscard]] Spread spread_over(const std::vector<RunoutRun>& runs, const std::vector<int>& some,
                                 double (*value)(const RunoutRun&));

/// Runs in which a block moved: run-out is undefined for the rest.
[[nodiscard]] int n_moved(const std::vector<RunoutRun>& runs);
/// Runs that are events (moved.hpp); places of them in `runs`.
[[nodiscard]] std::vector<int> events_among(const std::vector<RunoutRun>& runs,
                                            const std::vector<int>& some);
/// Share of the runs that are events, each run with its weight [-].
[[nodiscard]] double event_probability(const std::vector<RunoutRun>& runs,
                                       const std::vector<int>& some);
[[nodiscard]] std::vector<int> all_of(const std::vector<RunoutRun>& runs);

/// The run whose event came farthest along the path, the first of them; null when none moved.
[[nodiscard]] const RunoutRun* farthest_run(const std::vector<RunoutRun>& runs);

}  // namespace talus
