// verify/study/summary.hpp
// Tables of all cases, as Markdown: claim, reference, error, bound, CPU time, test; and errors at
// several time steps and settings.
#pragma once

#include <string>
#include <vector>

#include "verify/study/measure.hpp"

namespace talus {

/// The row of law talus with its defaults (step, stiffness, strains left out unless the case has
/// them); null when it was not run.
[[nodiscard]] const VerifyRow* default_row(const std::vector<VerifyRow>& rows);

/// Whether the default row's error is below the case's bound.
[[nodiscard]] bool holds(const MeasuredCase& measured);

/// A line a case: at the defaults, and law paper where it errs least.
[[nodiscard]] std::string summary_table(const std::vector<MeasuredCase>& cases);

/// A line a case: error and CPU time of both laws at several time steps each, law talus with its
/// defaults, law paper with the stiffness of the paper.
[[nodiscard]] std::string steps_table(const std::vector<MeasuredCase>& cases);

/// The same of law talus at the default step, one setting changed: stiffness, tolerance of the
/// solver, strains.
[[nodiscard]] std::string settings_table(const std::vector<MeasuredCase>& cases);

}  // namespace talus
