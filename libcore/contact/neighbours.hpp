// libcore/contact/neighbours.hpp
// Which boxes overlap: strips across the longest side of the box around all, each sorted along the
// next longest.
// in:    boxes, grouped by owner
// out:   overlapping pairs of different owners, in order
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hpp"

namespace talus {

struct Box {
  Vec3 low, high;
};

/// Whether boxes overlap or touch.
[[nodiscard]] inline bool overlap(const Box& one, const Box& other) {
  return one.low.x() <= other.high.x() && other.low.x() <= one.high.x() &&
         one.low.y() <= other.high.y() && other.low.y() <= one.high.y() &&
         one.low.z() <= other.high.z() && other.low.z() <= one.high.z();
}

struct BoxInStrip {
  int strip, first;  ///< `first`: of the strips that the box is in
  int box;
  double low;  ///< of the box along the strip [m]
};

/// All pairs (i, j), i < j, of boxes that overlap or touch, sorted by i, then by j, without those
/// with owner[i] == owner[j]. Boxes must be finite. `strips` is scratch.
void find_overlaps(std::span<const Box> boxes, std::span<const int> owner,
                   std::vector<BoxInStrip>& strips, std::vector<std::array<int, 2>>& pairs);

}  // namespace talus
