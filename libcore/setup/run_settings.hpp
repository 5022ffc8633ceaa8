// libcore/setup/run_settings.hpp: public
// Odd settings of a run: refused, or reported to the user.
#pragma once

#include <string>
#include <vector>

#include "base/input_log.hpp"
#include "setup/dda_inputs.hpp"
#include "site/plan.hpp"
#include "site/site.hpp"

namespace talus {

/// Throws InputError for time steps out of order, a duration below one step, or too many frames.
void check_times(const Site& site);

/// Whether another seed gives another run: by scatter, jitter, a sample, or a new stand of trees.
[[nodiscard]] bool seed_draws(const Site& site);

/// Warns of settings that do nothing, or that are unusual. Returns the warnings for the run file.
[[nodiscard]] std::vector<std::string> warn_of_settings(InputLog& log, const Site& site);

/// Adds the pieces into which blocks may break to the blocks of `inputs`, where [fragmentation] is
/// enabled; warns of blocks that stay whole.
void cut_fragments(InputLog& log, const Site& site, DdaInputs& inputs);

/// Warns of blocks that pass through each other, and of strains asked for that are not computed;
/// adds to inputs.warnings.
void warn_of_plan(InputLog& log, const Site& site, const ScenePlan& plan, DdaInputs& inputs);

}  // namespace talus
