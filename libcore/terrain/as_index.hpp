// libcore/terrain/as_index.hpp
// A number as the index of a container.
#pragma once

#include <cstddef>

namespace talus {

[[nodiscard]] constexpr std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

}  // namespace talus
