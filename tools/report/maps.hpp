// tools/report/maps.hpp
// The chapter of a report with its maps: where the blocks went, and what they brought to each cell.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

[[nodiscard]] std::string map_section(const ReportData& data);

}  // namespace talus
