// libcore/blocks/least_size.hpp: public
// The smallest blocks that are made and moved.
#pragma once

namespace talus {

/// Volume of a cube of 1 mm [m3]. Positions are kept, and overlaps at the start left alone, to that
/// length: the contacts of smaller blocks are not resolved. Tests cover blocks from 1 cm.
inline constexpr double least_volume = 1e-9;

}  // namespace talus
