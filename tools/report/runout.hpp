// tools/report/runout.hpp
// The chapter of a report on run-out: how far, how it spread over the runs, and beside published
// relations.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// Cases beside one another, and what the rest of the page makes of them; empty without cases.
[[nodiscard]] std::string case_table(const Texts& texts, const Json& runout);

/// Empty without the run-out's JSON.
[[nodiscard]] std::string runout_section(const ReportData& data);

}  // namespace talus
