// tools/report/objects.hpp
// What endangers each object, and where to act.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// Empty where talus-trace was not run.
[[nodiscard]] std::string object_section(const ReportData& data);

}  // namespace talus
