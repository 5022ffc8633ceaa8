// tools/report/result.hpp
// The first chapter of a report: what came out, in a few numbers and verdicts.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

[[nodiscard]] std::string result_section(const ReportData& data);

}  // namespace talus
