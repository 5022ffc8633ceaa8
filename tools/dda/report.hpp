// tools/dda/report.hpp
// Outcome of a run: talus-dda's answer, its one line, and its health.
#pragma once

#include <string>

#include "run/runner.hpp"
#include "site/plan.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// Parts left out of a scene, with the rule and its reason.
[[nodiscard]] Json plan_json(const ScenePlan& plan);

/// Counters, largest speed, mean displacement, panels and health of a run, which took `cpu_s` from
/// the time `from_s` on [s].
[[nodiscard]] Json run_report(const Runner& runner, const ScenePlan& plan, double from_s,
                              double cpu_s);

/// run_report() of the run `file` in one line.
[[nodiscard]] std::string run_summary(const Json& report, const RunFile& file);

/// Warns when less than half of the mass moved.
void warn_of_standing_mass(Tool& tool, const RunFile& file);

/// Gives the health to the tool, and the run the status "failed" with the reason where a limit is
/// broken.
void record_health(Tool& tool, Runner& runner);

}  // namespace talus
