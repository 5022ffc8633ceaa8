// libcore/base/words.hpp: public
// Quantities in sentences.
#pragma once

#include <string>

#include "base/text.hpp"

namespace talus {

/// A share, 0 to 1, in percent: three significant digits ("12.3 %", "0.0123 %", "100 %").
[[nodiscard]] inline std::string percent(double share) { return text(100 * share, 3) + " %"; }

}  // namespace talus
