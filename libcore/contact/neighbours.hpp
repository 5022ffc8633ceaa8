// libcore/contact/neighbours.hpp
// Which boxes overlap: a uniform grid for each size class of boxes, linear in their number.
// in:    boxes, grouped by owner
// out:   overlapping pairs of different owners, in order
#pragma once

#include <array>
#include <cstdint>
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

/// Arrays that find_overlaps fills anew; kept to spare allocation.
struct OverlapScratch {
  struct Item {
    std::uint64_t cell;  ///< level and cell of the box's centre
    int box;
  };
  struct Cell {
    std::uint64_t cell;
    int begin, end;  ///< items; begin = end: free slot of the hash table
  };
  std::vector<Item> items;                ///< sorted by cell, then by box
  std::vector<Cell> table;                ///< open addressing
  std::vector<std::array<int, 2>> found;  ///< pairs in the order they were met
  std::vector<int> begin;
};

/// All pairs (i, j), i < j, of boxes that overlap or touch, sorted by i, then by j.
///
/// Leaves out pairs with owner[i] == owner[j], and pairs where both are `fixed` (empty: none is).
/// A box of size class k (largest side in (2^(k-1), 2^k] times the smallest) lies in one cell of
/// the grid of its class, by its centre, and looks at the 27 cells around it in its and all coarser
/// grids. Where all boxes that are not fixed have one owner, those beside all fixed ones are not
/// looked at. Boxes must be finite.
void find_overlaps(std::span<const Box> boxes, std::span<const int> owner,
                   std::span<const std::uint8_t> fixed, OverlapScratch& scratch,
                   std::vector<std::array<int, 2>>& pairs);

}  // namespace talus
