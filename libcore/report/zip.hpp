// libcore/report/zip.hpp: public
// A ZIP archive of a few small files, stored without compression (PKWARE APPNOTE 6.3, sections 4.3
// and 4.4): a .qgz of QGIS. No time stamps, so equal content gives equal bytes.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace talus {

/// Name and content of each file; names in UTF-8 with forward slashes, below 4 GB in all.
[[nodiscard]] std::string zip_archive(
    const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace talus
