// tools/report/viewer.hpp
// The animation of a report: the place of the 3-D viewer, its data and its script.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// The chapter; empty when no run with frames is shown.
[[nodiscard]] std::string viewer_section(const ReportData& data);

/// What stands at the end of the page: the scene, and `viewer` (tools/report/viewer.js) with the
/// call that starts it. Empty like the chapter.
[[nodiscard]] std::string viewer_script(const ReportData& data, const std::string& viewer);

}  // namespace talus
