// libcore/setup/site_files.hpp: public
// Files that a site file names.
#pragma once

#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// Text of a TOML string without its quotes.
[[nodiscard]] std::string unquoted(const std::string& toml);

/// The file that a value names, without its part (a layer, a member of an archive); ""
/// where it names none, or one that GDAL alone knows.
[[nodiscard]] std::string file_named(const Site& site, const EffectiveValue& value);

/// All of them, with the GeoPackage of [site] layers, whether or not they are there.
[[nodiscard]] std::vector<std::string> files_named(const Site& site);

}  // namespace talus
