// libcore/ensemble/run_tags.hpp: public
// Tags with which every output describes the runs that it was made from.
// in:    the runs, and failed ones that were left out
// out:   names with their values, the same in whatever order the runs come
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ensemble/run_set.hpp"

namespace talus {

/// Tags N_RUNS, N_FAILED, DENOMINATOR, INTERVALS_OVER, VERSION, SITE, HEALTH, HEALTH_* and, where
/// there are any, N_LEFT_OUT, N_REPEATS and WARNINGS; the same in whatever order the runs come.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> tags_of(
    const std::vector<RunMember>& runs, const std::vector<RunMember>& left_out = {});

}  // namespace talus
