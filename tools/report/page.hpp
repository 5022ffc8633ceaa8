// tools/report/page.hpp
// A report as one HTML file: head, chapters, scripts.
#pragma once

#include <string>

#include "tools/report/data.hpp"

namespace talus {

/// What is shipped with the tool.
struct PageFiles {
  std::string style, viewer, maps;  ///< CSS, scripts of the 3-D viewer and of the maps
};
[[nodiscard]] std::string report_page(const ReportData& data, const PageFiles& files);

}  // namespace talus
