// tools/report/uncertainty.hpp
// The chapter of a report on what differs from run to run: what was drawn, what results owe to it,
// and how surely places are reached.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// Empty where nothing was drawn and no place is named.
[[nodiscard]] std::string uncertainty_section(const ReportData& data);

}  // namespace talus
