// libcore/report/run_health.hpp: public
// Whether runs kept to their limits, and their numerical health.
// in:    checks of the registry, health of the run files
// out:   rows of tables, each with the list of its fields
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "record/run_file.hpp"
#include "store/runs.hpp"

namespace talus {

/// A limit over all runs.
struct LimitOverRuns {
  std::string name;
  double worst = 0, limit = 0;  ///< in the unit that the name ends in
  int n_failed = 0;             ///< runs beyond it
};
[[nodiscard]] const std::vector<Field<LimitOverRuns>>& limit_fields();

/// Takes in the checks of one more run.
void add_limits(const std::vector<RunCheck>& checks, std::vector<LimitOverRuns>& limits);

/// All runs have finished, none beyond a limit.
[[nodiscard]] bool all_pass(const std::vector<RunFile>& runs,
                            const std::vector<LimitOverRuns>& limits);

/// How far a run came, its steps, and its faults.
struct RunHealth {
  const std::string& name;
  const RunInfo& info;
  HealthRow whole;  ///< counts and cuts summed, the largest penetration, the shortest step
};
/// `names`: one a run.
[[nodiscard]] std::vector<RunHealth> health_of(const std::vector<RunFile>& runs,
                                               const std::vector<std::string>& names);
[[nodiscard]] const std::vector<Field<RunHealth>>& counter_fields();
/// How often islands made a substep again, by reason (docs/theory/theory.md, stage 8).
[[nodiscard]] const std::vector<Field<RunHealth>>& cut_fields();

/// A block that was deep in something.
struct DeepOfRun {
  const std::string& name;  ///< of the run
  const RunFile& run;
  const DeepRow& row;
};
[[nodiscard]] std::vector<DeepOfRun> deep_of_runs(const std::vector<RunFile>& runs,
                                                  const std::vector<std::string>& names);
[[nodiscard]] const std::vector<Field<DeepOfRun>>& deep_fields();

}  // namespace talus
