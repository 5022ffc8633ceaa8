// libcore/report/run_health.hpp: public
// Whether runs kept to their limits, and what went on inside of them, as tables of a page.
// in:    checks of the registry, health of the run files
// out:   HTML
#pragma once

#include <string>
#include <vector>

#include "record/run_file.hpp"
#include "report/texts.hpp"
#include "store/runs.hpp"

namespace talus {

/// A limit over all runs.
struct LimitOverRuns {
  std::string name;
  double worst = 0, limit = 0;  ///< in the unit that the name ends in
  int n_failed = 0;             ///< runs beyond it
};

/// Takes in the checks of one more run.
void add_limits(const std::vector<RunCheck>& checks, std::vector<LimitOverRuns>& limits);

/// All runs have finished, none beyond a limit.
[[nodiscard]] bool all_pass(const std::vector<RunFile>& runs,
                            const std::vector<LimitOverRuns>& limits);

/// A row a limit.
[[nodiscard]] std::string limit_table(const Texts& texts, const std::vector<LimitOverRuns>& limits,
                                      std::size_t n_runs);

/// A row a run: how far it came, its steps, and what was not as it should be. `names`: one a run.
[[nodiscard]] std::string counter_table(const Texts& texts, const std::vector<RunFile>& runs,
                                        const std::vector<std::string>& names);

/// A row a run: how often islands made a substep again, by reason (docs/theory/theory.md, stage 8);
/// empty when none did.
[[nodiscard]] std::string cut_table(const Texts& texts, const std::vector<RunFile>& runs,
                                    const std::vector<std::string>& names);

/// A row a block that was deep in something; empty when there was none. `names`: one a run.
[[nodiscard]] std::string deep_table(const Texts& texts, const std::vector<RunFile>& runs,
                                     const std::vector<std::string>& names);

}  // namespace talus
