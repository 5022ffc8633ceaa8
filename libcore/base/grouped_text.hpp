// libcore/base/grouped_text.hpp: public
// Numbers for readers: no power of ten where digits can be read, thousands apart.
#pragma once

#include <string>

namespace talus {

/// Of quantities in terminals, reports and pages: no result is surer than that. Files hold more.
inline constexpr int shown_digits = 3;

/// text(value, digits) without a power of ten below 1e9 and with thousands apart ("12,400").
[[nodiscard]] std::string grouped_text(double value, int digits = shown_digits);

/// The same for a required capacity: rounded up, for values of 0 and above.
[[nodiscard]] std::string needed_text(double value, int digits = shown_digits);

}  // namespace talus
