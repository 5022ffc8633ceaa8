// verify/cases/claims.hpp
// CPU time at equal error, law talus with its default settings against law paper and against other
// engines, as tables.
// in:    the rows of each case, with any time step
// out:   ratios of CPU time; above 1 law talus takes less
#pragma once

#include <string>
#include <vector>

#include "verify/study/measure.hpp"

namespace talus {

/// Law talus against law paper; errors below the uncertainty of the reference count as equal.
[[nodiscard]] LawComparison laws_of(const MeasuredCase& measured);

/// CPU time of other engines over that of law talus at equal error, least over the front of their
/// runs that err by at most `measured.worst`; NaN without such a run, 0 where talus never gets as
/// close. Of law talus with its default settings and any step, or with the default step alone.
[[nodiscard]] double peer_ratio(const MeasuredCase& measured, bool default_step_only);

/// The least of each ratio over cases that belong together, and of which case it is.
[[nodiscard]] std::string claims_by_group(const std::vector<MeasuredCase>& cases);

/// Of the cases that law paper ran too: those with a step of law talus on the front of both.
struct FrontCount {
  int n_on_front = 0, n_compared = 0;
};
[[nodiscard]] FrontCount front_count(const std::vector<MeasuredCase>& cases);

}  // namespace talus
