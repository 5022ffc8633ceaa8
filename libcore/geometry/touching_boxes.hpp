// libcore/geometry/touching_boxes.hpp: public
// Which of many boxes in plan touch, without asking each pair.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.hpp"

namespace talus {

struct Box2 {
  Vec2 low, high;
};

struct TouchingBoxes {
  std::vector<std::array<int, 2>> pairs;  ///< first < second, sorted
  std::int64_t n_compared = 0;            ///< pairs that were looked at
};

/// All pairs of boxes that share a point. The boxes are swept along the axis on which they overlap
/// less: the sides of an outline of n corners take a small multiple of n comparisons, and n log n
/// steps.
[[nodiscard]] TouchingBoxes touching_boxes(const std::vector<Box2>& boxes);

}  // namespace talus
