// libcore/setup/section_state_gdal.hpp: public
// State of sections of a site file, with the files that they name: results record it, and a report
// compares it.
#pragma once

#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// Digest of the effective values of `sections` ("object" means all [object.*]), of all files
/// of the data sets that they name, and of the features of layers that define them
/// (site_layers.hpp).
[[nodiscard]] std::string section_state(const Site& site, const std::vector<std::string>& sections);

}  // namespace talus
