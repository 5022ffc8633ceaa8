// tools/frame/gone_options.hpp
// Options that a release no longer has, and their replacement. A row stays for one release.
#pragma once

#include <string>

namespace talus {

/// Replacement of the first option of a command line that is gone from `tool`; empty: none is gone.
[[nodiscard]] std::string written_instead(const std::string& tool, int argc, char** argv);

}  // namespace talus
