// tools/report/page.hpp
// A report as one HTML file: head, chapters, scripts.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// `viewer` is the script of the 3-D viewer, `style` the page's CSS.
[[nodiscard]] std::string report_page(const ReportData& data, const std::string& viewer,
                                      const std::string& style);

}  // namespace talus
