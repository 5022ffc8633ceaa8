// libcore/io/network_gdal.hpp
// Files of strangers must not make GDAL ask other machines, or read what nobody named.
// in:    network_is_allowed() (base/network.hpp)
#pragma once

#include <string>

namespace talus {

/// Once drivers are registered: those that live on a network and those whose headers name a file of
/// raw bytes are taken out, file systems and downloads over a network are refused, virtual rasters
/// run no Python and take no raw bytes, data bases have no virtual tables that read other files.
void forbid_network();

/// Throws InputError where a virtual data set, or one that it names, is of a network.
void check_virtual(const std::string& path);

/// The way out where GDAL's failure to open or read a file comes from what forbid_network() takes
/// out; empty where it does not.
[[nodiscard]] std::string needs_permission(const std::string& failure);

}  // namespace talus
