// libcore/base/network.hpp: public
// Whether this process may reach out to other machines, and read files that inputs do not name
// openly. It may not, unless who runs it says so (--allow-network).
#pragma once

namespace talus {

/// Once, before any file is read.
void allow_network();
[[nodiscard]] bool network_is_allowed();

}  // namespace talus
