// tools/report/project.hpp
// Content of the QGIS project of a site.
#pragma once

#include <string>

#include "report/qgis_project.hpp"
#include "tools/report/data.hpp"
#include "tools/report/folder.hpp"

namespace talus {

/// Of the results in the folder, with paths relative to the project `file`.
[[nodiscard]] QgisProject project_of(const ReportData& data, const std::string& file,
                                     const ResultFolder& folder);

}  // namespace talus
