// libcore/setup/section_state_gdal.hpp: public
// What sections of a site file say, with the files that they name: results bear it, and a report
// compares it.
#pragma once

#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// As section_digest() of site/section_digest.hpp; where a named file is part of a data set (a
/// Shapefile, an archive, a folder), all files of that count.
[[nodiscard]] std::string section_state(const Site& site, const std::vector<std::string>& sections);

}  // namespace talus
