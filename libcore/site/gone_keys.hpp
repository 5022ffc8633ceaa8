// libcore/site/gone_keys.hpp
// Keys that a release no longer reads, and what to write instead. A row stays for one release.
#pragma once

#include <string>
#include <string_view>

namespace talus {

/// What to write instead of a key that is gone from `section` ("source", "fence.upper"); empty: it
/// never was one.
[[nodiscard]] std::string written_instead(const std::string& section, std::string_view key);

}  // namespace talus
