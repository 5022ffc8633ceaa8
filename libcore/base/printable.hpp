// libcore/base/printable.hpp: public
// Makes untrusted text safe to show on a terminal, in a table, a page or JSON: one rule for all.
#pragma once

#include <string>
#include <string_view>

namespace talus {

/// Control characters except line feeds and tabs, characters that turn the direction of text or
/// break lines unseen, and bytes that are not UTF-8 are written as \x1b or \u202e; all else is
/// kept. printable(printable(t)) is printable(t).
[[nodiscard]] std::string printable(std::string_view text);

/// The same for JSON and TOML: such a character in a text becomes \u001b, which means the same.
[[nodiscard]] std::string printable_json(std::string_view json);

}  // namespace talus
