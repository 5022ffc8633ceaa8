// libcore/post/runout/runout_text.hpp: public
// How far runs came, in words and as tables.
// in:    the data kept of the runs (runout_runs.hpp)
// out:   a summary of some lines; rows of blocks and of curves over time
#pragma once

#include <string>

#include "post/runout/runout_runs.hpp"

namespace talus {

/// Runs that did not move, how much of the mass did, H, L and angle of reach of a run or their
/// ranges over those that moved, and the balance of volumes.
[[nodiscard]] std::string runout_summary(const RunoutRuns& all);

/// A row (CSV) for each block of each run: its fate and how far it came. `origin`: map coordinates
/// of the local origin [m].
[[nodiscard]] std::string block_csv(const std::vector<RunoutRun>& runs, const Vec3& origin);

/// A row (CSV) for each run: how much of the mass moved and how far, H, L and angle of reach.
[[nodiscard]] std::string run_csv(const std::vector<RunoutRun>& runs);

/// "19 of 36 runs did not move (no block by more than 1 m), and 5 of 36 runs moved less than 10 %
/// of the mass"; "" when all are events.
[[nodiscard]] std::string standing_runs(const std::vector<RunoutRun>& runs);

/// "95 % of what moved came within 162 m of its top, 126 m below (37.8 deg); 10 blocks, 4 % of it,
/// went farther; the farthest is 0.3 % of it, an outlier"
[[nodiscard]] std::string text(const MassReach& reach);

/// A line a case: runs that moved, mass that moved, largest L and L95, smallest angle; "" where
/// there is one case.
[[nodiscard]] std::string cases_text(const std::vector<RunoutRun>& runs);

/// Where the angle of the energy line that passes all of the ground is smaller than that to the toe
/// by a degree or more: which angle to take, and why; "" else.
[[nodiscard]] std::string energy_line_text(const AngleProfile& profile);

/// A row (CSV) for each frame of each run that has them. `origin`: map coordinates of the local
/// origin [m].
[[nodiscard]] std::string curve_csv(const std::vector<RunoutRun>& runs, const Vec3& origin);

}  // namespace talus
