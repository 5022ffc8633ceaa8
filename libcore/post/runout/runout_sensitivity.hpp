// libcore/post/runout/runout_sensitivity.hpp: public
// Sensitivity of the results of many runs to the quantities that they drew.
// in:    run-out, arrivals at lines and drawn values of each run
// out:   for each result and quantity a rank correlation and a first-order index
#pragma once

#include <string>
#include <vector>

#include "base/fields.hpp"
#include "post/runout/runout_runs.hpp"

namespace talus {

struct SensitivityRow {
  std::string result;           ///< "L_path_m", "crossed.FENCE", "energy_kj.FENCE"
  std::string quantity;         ///< key of the site file, or "rock_mass"
  int n = 0;                    ///< runs that have the result
  double rank_correlation = 0;  ///< NaN where there is none: of rock masses, which have no order
  double first_order = 0;       ///< share of the variance that the quantity alone explains
};

/// Rows by result, then quantity; none where nothing was drawn. Results and quantities that are the
/// same in all runs are left out. With fewer than least_runs_for_sensitivity runs both numbers are
/// NaN: not enough runs.
[[nodiscard]] std::vector<SensitivityRow> sensitivity_of(const std::vector<RunoutRun>& runs);

[[nodiscard]] const std::vector<Field<SensitivityRow>>& sensitivity_fields();

}  // namespace talus
