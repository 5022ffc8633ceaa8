// tools/frame/gone_options.hpp
// Options that a release no longer has, and what to write instead. A row stays for one release.
#pragma once

#include <string>

namespace talus {

/// What to write instead of the first option of a command line that is gone from `tool`; empty:
/// none of them is.
[[nodiscard]] std::string written_instead(const std::string& tool, int argc, char** argv);

}  // namespace talus
