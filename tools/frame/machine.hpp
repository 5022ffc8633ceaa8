// tools/frame/machine.hpp
// The machine that a run is computed on.
#pragma once

#include <string>

namespace talus {

/// Name of this machine in its network, "unknown" where it has none.
[[nodiscard]] std::string host_name();

/// Model of the processor, "unknown" where /proc/cpuinfo does not say.
[[nodiscard]] std::string processor_name();

}  // namespace talus
