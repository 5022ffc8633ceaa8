// libcore/base/numbers.hpp: public
// Numbers that have a name of their own.
#pragma once

#include <limits>

namespace talus {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double no_value = std::numeric_limits<double>::quiet_NaN();  ///< there is none

}  // namespace talus
