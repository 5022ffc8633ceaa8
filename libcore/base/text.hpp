// libcore/base/text.hpp: public
// Numbers as text, the same for every locale, and the nearest known name for a misspelt one; text
// in XML.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// Shortest decimal text that reads back to the same double ("0.1", "1e-12", "nan").
[[nodiscard]] std::string text(double value);

/// `value` with `digits` significant digits, without trailing zeros ("12.35").
[[nodiscard]] std::string text(double value, int digits);

/// "1 block", "2 blocks".
[[nodiscard]] std::string counted(std::int64_t n, const std::string& noun);

/// The whole of `text` as a finite double; false when it is anything else. Locale independent.
[[nodiscard]] bool parse_double(std::string_view text, double& value);

/// The entry of `known` with the smallest edit distance to `name`; empty when none is near
/// (distance above a third of the name's length).
[[nodiscard]] std::string nearest_name(std::string_view name,
                                       const std::vector<std::string>& known);

/// `line` as lines of at most `columns` letters where it can be parted behind a "; ": those that
/// follow are indented. A phrase that is longer stays whole.
[[nodiscard]] std::string folded(std::string_view line, std::size_t columns);

/// Lower case of the ASCII letters; other bytes as they are.
[[nodiscard]] std::string lower(std::string_view text);

/// `text` with & < > " as entities: safe as HTML or XML text and in quoted attributes. Control
/// characters that XML 1.0 forbids are left out.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace talus
