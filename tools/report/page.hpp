// tools/report/page.hpp
// The page: values for its template (page.html) and its texts.
#pragma once

#include <string>
#include <vector>

#include "tools/report/data.hpp"

namespace talus {

/// Files that are built in.
struct PageFiles {
  std::string page, style, viewer, profile, maps;  ///< template, CSS, scripts
};

[[nodiscard]] std::string report_page(const ReportData& data, const PageFiles& files);

/// Names of the rasters of hazard.json, the class first.
[[nodiscard]] std::vector<std::string> hazard_maps_of(const Json& hazard);

/// The value at a path of keys; null where any is missing.
[[nodiscard]] Json value_at(const Json& json, std::initializer_list<const char*> keys);

}  // namespace talus
