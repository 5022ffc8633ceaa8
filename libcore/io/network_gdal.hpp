// libcore/io/network_gdal.hpp
// Files of strangers must not make GDAL and PROJ ask other machines, or read what nobody named.
// in:    network_is_allowed() (base/network.hpp)
#pragma once

#include <string>

namespace talus {

/// Once drivers are registered: those that live on a network are taken out, file systems and
/// downloads over one are refused, PROJ fetches no grids, virtual rasters run no Python.
void forbid_network();

/// Throws InputError where a virtual data set, or one that it names, is of a network or takes the
/// raw bytes of a file.
void check_virtual(const std::string& path);

}  // namespace talus
