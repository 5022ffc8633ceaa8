// libcore/base/network.hpp: public
// Switch of this process for access to other machines, and to files that an input names within
// itself, such as the sources of a VRT. Off unless the user allows it (--allow-network).
#pragma once

namespace talus {

/// Call it before any file is read.
void allow_network();
[[nodiscard]] bool network_is_allowed();

}  // namespace talus
