// libcore/setup/section_state_gdal.hpp: public
// What sections of a site file say, with the files that they name: results bear it, and a report
// compares it.
#pragma once

#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// Digest of the effective values of `sections` ("object" stands for all [object.*]), of all files
/// of the data sets that they name, and of the features of layers that stand for them
/// (site_layers.hpp).
[[nodiscard]] std::string section_state(const Site& site, const std::vector<std::string>& sections);

}  // namespace talus
