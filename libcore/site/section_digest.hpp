// libcore/site/section_digest.hpp: public
// What sections of a site file say, as a digest: a result that was made with other values of them
// is an old one.
#pragma once

#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// Of the effective values of `sections` ("object" stands for all [object.*]), of the bytes of the
/// files that they name, and of the features of layers that stand for them (site_layers.hpp).
[[nodiscard]] std::string section_digest(const Site& site,
                                         const std::vector<std::string>& sections);

}  // namespace talus
