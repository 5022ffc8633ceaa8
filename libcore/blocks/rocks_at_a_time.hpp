// libcore/blocks/rocks_at_a_time.hpp: public
// How many rocks that fall one by one are computed together (run/rocks.hpp).
#pragma once

namespace talus {

/// So few that their data stay in the cache.
inline constexpr int rocks_at_a_time = 16;

}  // namespace talus
