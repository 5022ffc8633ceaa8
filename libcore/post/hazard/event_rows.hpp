// libcore/post/hazard/event_rows.hpp
// Passages as hazard classes count them.
// in:    passages of a run by cell (post/maps/map_rows.hpp), its blocks, a recipe
//        How often a rock hits a cell depends on the size of cells, which says nothing of a hazard.
//        Recipes therefore give the width of what is hit: a rock hits all that is so wide and that
//        its path crosses. A mass is as wide as it is.
// out:   rows of 32 bytes, by cell, then run
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "ensemble/run_set.hpp"
#include "post/hazard/recipe.hpp"
#include "post/maps/map_rows.hpp"

namespace talus {

struct EventRow {
  std::uint32_t cell = 0;
  std::int32_t run = 0, block = 0;
  float energy = 0;     ///< largest kinetic energy with spin of a block over the cell [kJ]
  float intensity = 0;  ///< measure that the recipe's breaks divide, raised by its rule for masses
  double weight = 1;    ///< of the block, times that of its run
};

/// Whether each block that a run released is an event of its own: it moved as if it were alone, has
/// a frequency, or is the only one.
[[nodiscard]] bool blocks_are_events(const RunInfo& run, int n_released);

/// A run as its class counts it.
struct EventSource {
  const RunMember& run;
  int index = 0;          ///< place among all runs
  bool of_rocks = false;  ///< each block is an event, by the class
};

using TakeEvent = std::function<void(const EventRow&)>;
/// Calls take(row) for the passages of a run. Where it released more than the recipe's volume of a
/// mass, a block that is not alone in a cell has at least the intensity of a mass; rocks that moved
/// as if they were alone are none. Where a block is an event of its own, it has a row in all cells
/// within half of the recipe's width across its heading, weighed by the probability to hit what is
/// so wide and centred there.
void event_rows(const std::vector<MapRow>& rows, const PassageGrid& grid, const RunBlocks& blocks,
                const Recipe& recipe, const EventSource& of, const TakeEvent& take);
/// How many cells beside a passage its rows may be.
[[nodiscard]] int cells_beside(const PassageGrid& grid, const RunBlocks& blocks,
                               const Recipe& recipe, bool of_rocks);

/// By cell, run, then all else, so that the rows alone say their order.
void sort_events(std::vector<EventRow>& rows);

}  // namespace talus
