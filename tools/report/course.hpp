// tools/report/course.hpp
// The chapters of a report on how the runs went: curves over time, and whether the numbers held.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// Curves of speed, path and energy; empty without talus-runout's curves.
[[nodiscard]] std::string curve_section(const ReportData& data);

/// Limits, counters and energy balance.
[[nodiscard]] std::string health_section(const ReportData& data);

}  // namespace talus
