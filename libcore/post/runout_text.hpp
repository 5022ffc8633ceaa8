// libcore/post/runout_text.hpp
// How far runs came, in words and as tables.
// in:    what was kept of the runs (runout_runs.hpp)
// out:   a summary of some lines; rows of blocks and of curves over time
#pragma once

#include <string>

#include "post/runout_runs.hpp"

namespace talus {

/// H, L and angle of reach of a run, or their ranges over several, and the balance of volumes.
[[nodiscard]] std::string runout_summary(const RunoutRuns& all);

/// A row (CSV) for each block of each run: its fate and how far it came.
[[nodiscard]] std::string block_csv(const std::vector<RunoutRun>& runs);

/// A row (CSV) for each frame of each run. `origin`: map coordinates of the local origin [m].
[[nodiscard]] std::string curve_csv(const std::vector<RunoutRun>& runs, const Vec3& origin);

}  // namespace talus
