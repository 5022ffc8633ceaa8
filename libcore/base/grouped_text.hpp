// libcore/base/grouped_text.hpp: public
// Numbers for readers: no power of ten where digits can be read, thousands apart.
#pragma once

#include <string>

namespace talus {

/// text(value, digits) without a power of ten below 1e9 and with thousands apart ("12,430").
[[nodiscard]] std::string grouped_text(double value, int digits);

}  // namespace talus
