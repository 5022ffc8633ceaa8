// libcore/geometry/orient2d.hpp
// On which side of a line a point lies, without rounding errors. Decides where lines of a map meet.
// Source: J. R. Shewchuk (1997), Adaptive precision floating-point arithmetic, Discrete Comput.
// Geom. 18.
#pragma once

#include "base/types.hpp"

namespace talus {

/// Sign of the area of triangle a, b, c: 1 counter-clockwise, -1 clockwise, 0 exactly on one line.
/// Exact for finite coordinates whose products neither overflow nor underflow (|x| below 1e150).
[[nodiscard]] int orient2d(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace talus
