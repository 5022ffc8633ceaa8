// tools/report/json.hpp
// Values of the tools' JSON as text of a page: HTML, a dash where there is none.
#pragma once

#include <initializer_list>
#include <string>

#include "base/grouped_text.hpp"
#include "report/texts.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// The value at a path of keys; null where any is missing.
[[nodiscard]] Json value_at(const Json& json, std::initializer_list<const char*> keys);

/// A number with `digits` significant digits, a whole one with all; "yes" or "no" of a truth value.
[[nodiscard]] std::string number_text(const Json& value, int digits = shown_digits);

/// A share, 0 to 1, in percent with its sign.
[[nodiscard]] std::string percent_text(const Json& value);

/// "12 % to 25 %", of two texts.
[[nodiscard]] std::string range_text(const Texts& texts, const std::string& low,
                                     const std::string& high);

/// "12 runs".
[[nodiscard]] std::string runs_text(const Texts& texts, std::int64_t n);

/// A text, escaped; empty where there is none.
[[nodiscard]] std::string word_text(const Json& value);

}  // namespace talus
