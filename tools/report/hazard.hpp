// tools/report/hazard.hpp
// The section on return periods and hazard classes.
#pragma once

#include <string>
#include <vector>

#include "tools/report/data.hpp"

namespace talus {

/// Names of the maps that HAZARD.json lists, without folder and ending.
[[nodiscard]] std::vector<std::string> hazard_maps_of(const Json& hazard);

/// Empty where talus-hazard was not run.
[[nodiscard]] std::string hazard_section(const ReportData& data);

}  // namespace talus
