// tools/report/search.hpp
// Where a fence protects an object best: options, and what proposals let through where they stood.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// Empty where talus-fence-search was not run.
[[nodiscard]] std::string search_section(const ReportData& data);

}  // namespace talus
