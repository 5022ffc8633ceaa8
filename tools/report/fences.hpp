// tools/report/fences.hpp
// What fences do, as a report says it: verdict, arrivals, fields, and the slide with and without.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// Whether a fence meets its design code, and what it would need; `fence` of the fences' JSON.
[[nodiscard]] std::string fence_verdict(const Texts& texts, const Json& fence);

/// The verdicts that count: of each case where there are several that nobody weighed, else of all
/// runs.
[[nodiscard]] std::string fence_verdicts(const ReportData& data);

/// The chapter; empty without the fences' JSON.
[[nodiscard]] std::string fence_section(const ReportData& data);

}  // namespace talus
