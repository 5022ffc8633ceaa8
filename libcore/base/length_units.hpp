// libcore/base/length_units.hpp: public
// The words that files write for units of length.
#pragma once

#include <string>

namespace talus {

inline constexpr double foot_m = 0.3048, us_foot_m = 1200.0 / 3937;

/// Whether a file says no unit: an empty text, or a word like "unspecified".
[[nodiscard]] bool is_no_unit(const std::string& word);

/// Metres in one unit: 1 for "m", "metros" or "m a.s.l.", 0.3048 for "ft". 0 where the word is not
/// known. Case, blanks and signs do not count.
[[nodiscard]] double metres_in(const std::string& word);

}  // namespace talus
