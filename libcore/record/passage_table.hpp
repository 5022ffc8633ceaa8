// libcore/record/passage_table.hpp
// Rows of passages: one for each block and cell, found by both.
// in:    visits of blocks to cells, in any order
// out:   rows whose number grows with the cells touched; the largest value of each quantity
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace talus {

/// The largest values of a block while it was over a cell. Floats: a maximum of rounded numbers is
/// the rounded maximum, so rounding early changes nothing.
struct PassageValues {
  static constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  float speed = 0;                  ///< of the centroid [m/s]
  float translational_energy = 0;   ///< [J]
  float total_energy = 0;           ///< translation and rotation at the same moment [J]
  float centroid_height = unknown;  ///< above the ground below it; NaN: no known ground [m]
  float top_height = unknown;  ///< of the highest vertex above the ground below the centroid [m]

  void raise(const PassageValues& other);  ///< element-wise maximum; NaN is ignored
};

struct Passage {
  std::int32_t block = 0;
  std::int32_t cell = 0;  ///< index in the grid
  PassageValues largest;
  float first_time = 0;  ///< when the block came over the cell [s]
  /// Then: from its centroid's start, below the horizontal, atan(drop / length of its path in plan)
  /// [rad]; NaN before it has moved in plan.
  float travel_angle = PassageValues::unknown;
  float heading = PassageValues::unknown;  ///< then, from x to y [rad]; NaN: at rest in plan
};

/// Rows with an index over (block, cell): open addressing, grown by doubling.
struct PassageTable {
  std::vector<Passage> rows;         ///< in the order of the first visit
  std::vector<std::uint32_t> slots;  ///< row + 1, 0 empty; a power of two

  /// The row of a block and cell that the block came over at `time` or before, else null.
  [[nodiscard]] Passage* earlier(std::int32_t block, std::int32_t cell, float time);
  /// A block over a cell: its values raise those of earlier visits, its arrival counts if it is the
  /// first.
  void raise(const Passage& visit);
};

/// Rows to be written, in the order of block, then cell.
[[nodiscard]] std::vector<Passage> sorted(const PassageTable& table);

}  // namespace talus
