// libcore/post/hazard/event_rows.hpp
// Passages as hazard classes count them.
// in:    passages of a run by cell (post/maps/map_rows.hpp), its blocks, a recipe
// out:   rows of 32 bytes, by cell, then run
#pragma once

#include <cstdint>
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

/// Of the passages of `run`, which has the place `index` among all. Where it released more than the
/// recipe's volume of a mass, a block that is not alone in a cell has at least the intensity of a
/// mass; rocks that moved as if they were alone are none.
[[nodiscard]] std::vector<EventRow> event_rows(const std::vector<MapRow>& rows,
                                               const RunBlocks& blocks, const Recipe& recipe,
                                               const RunMember& run, int index);

/// By cell, run, then all else, so that the rows alone say their order.
void sort_events(std::vector<EventRow>& rows);

}  // namespace talus
