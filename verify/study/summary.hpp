// verify/study/summary.hpp
// The table of all cases, as Markdown: claim, reference, error, bound, CPU time, test.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verify/study/measure.hpp"

namespace talus {

/// The row of law talus with its defaults (step, stiffness, strains left out unless the case has
/// them); null when it was not run.
[[nodiscard]] const VerifyRow* default_row(const std::vector<VerifyRow>& rows);

/// Whether the default row's error is below the case's bound.
[[nodiscard]] bool holds(const MeasuredCase& measured);

/// A line a case: at the defaults, law paper's smallest error, and its CPU time there over that of
/// the cheapest step of law talus with no larger error. With the folder of the diagrams each case
/// is a link to its own.
[[nodiscard]] std::string summary_table(const std::vector<MeasuredCase>& cases,
                                        const std::optional<std::string>& pictures = {});

}  // namespace talus
