// libcore/site/gone_keys.hpp
// Keys that a release no longer reads, and their replacement. A row stays for one release.
#pragma once

#include <string>
#include <string_view>

namespace talus {

/// Replacement of a key that is gone from `section` ("source", "fence.upper"); empty: the key never
/// existed.
[[nodiscard]] std::string written_instead(const std::string& section, std::string_view key);

}  // namespace talus
