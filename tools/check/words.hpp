// tools/check/words.hpp
// Results of a look at a site, as JSON and as lines for a terminal.
#pragma once

#include <string>

#include "tools/check/look.hpp"

namespace talus {

/// The same for the same inputs: no times of the machine.
[[nodiscard]] Json check_json(const Look& look, const std::string& run_id);

/// `doubts`: those of the page. `n_runs`: that are to be computed.
[[nodiscard]] std::string check_text(const Look& look, const std::vector<Doubt>& doubts,
                                     std::int64_t n_runs);

/// The parts of check_text() that the page shows too.
[[nodiscard]] std::string motion_text(const Look& look);
[[nodiscard]] std::string time_text(const Look& look, std::int64_t n_runs, bool of_this_machine);

}  // namespace talus
