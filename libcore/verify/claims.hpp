// CPU time at equal error, law talus with its default settings against law paper and against other
// engines: what was asked for and what was measured, as a table.
// in:    the rows of each case, with any time step
// out:   ratios of CPU time; above 1 law talus takes less
#pragma once

#include <string>
#include <vector>

#include "verify/measure.hpp"

namespace talus {

/// Ratio to law paper that was asked for: 10 on sliding, 50 on bounce and the slide, else 0.
[[nodiscard]] double asked_of_paper(const std::string& case_name);

/// How law talus stands to law paper, errors below what the reference is known to made equal.
[[nodiscard]] LawComparison laws_of(const MeasuredCase& measured);

/// CPU time of other engines over that of law talus at equal error, least over the front of their
/// runs that err by at most `measured.worst`; NaN without such a run, 0 where talus never gets as
/// close. Of law talus with its default settings and any step, or with the default step alone.
[[nodiscard]] double peer_ratio(const MeasuredCase& measured, bool default_step_only);

/// A line a case that another law or engine was measured on.
[[nodiscard]] std::string claims_table(const std::vector<MeasuredCase>& cases);

/// What was asked for, case by case taken together: the least of each ratio, and whether it holds.
[[nodiscard]] std::string claims_list(const std::vector<MeasuredCase>& cases);

}  // namespace talus
