// tools/report/basis.hpp
// The chapters of a report on what its results rest on: assumptions and how sure they are, what was
// computed and what left out, and the files and programs that it came from.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// Settings given and defaults, joints and sizes, and what is known of errors.
[[nodiscard]] std::string assumption_section(const ReportData& data);

/// The scene plan of the run that is shown.
[[nodiscard]] std::string plan_section(const ReportData& data);

/// The steps from the first files to the results.
[[nodiscard]] std::string provenance_section(const ReportData& data);

}  // namespace talus
