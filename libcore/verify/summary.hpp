// libcore/verify/summary.hpp
// The one table of all cases, as Markdown: claim, reference, error, bound, CPU time, test.
#pragma once

#include <string>
#include <vector>

#include "verify/measure.hpp"

namespace talus {

/// A case with all its rows.
struct CaseOutcome {
  const VerifyCase* about = nullptr;
  std::vector<VerifyRow> rows;
};

/// The row of law talus with its defaults (step, stiffness, strains left out unless the case has
/// them); null when it was not run.
[[nodiscard]] const VerifyRow* default_row(const std::vector<VerifyRow>& rows);

/// Whether the default row's error is below the case's bound.
[[nodiscard]] bool holds(const CaseOutcome& outcome);

/// A line a case.
[[nodiscard]] std::string summary_table(const std::vector<CaseOutcome>& outcomes);

}  // namespace talus
