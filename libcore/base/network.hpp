// libcore/base/network.hpp: public
// Whether this process may contact other machines, and read files that inputs do not name openly.
// It may not, unless the user allows it (--allow-network).
#pragma once

namespace talus {

/// Once, before any file is read.
void allow_network();
[[nodiscard]] bool network_is_allowed();

}  // namespace talus
