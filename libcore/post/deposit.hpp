// libcore/post/deposit.hpp: public
// Where the blocks are when a run ends: at rest, gone, or still moving, and the volume of each.
// in:    the last frame and the blocks of a run
// out:   fates and their balance, footprints, volume over each cell
#pragma once

#include <map>
#include <vector>

#include "post/maps/maps.hpp"
#include "record/run_file.hpp"

namespace talus {

enum class Fate { deposited, moving, left_domain };
[[nodiscard]] const char* text(Fate fate);

/// Asleep, or slower than `rest_speed` in the last frame: deposited. A run that does not say which
/// blocks left the terrain has none that did.
[[nodiscard]] Fate fate_of(const RunFile& run, int block, double rest_speed);

[[nodiscard]] std::vector<double> weights_of(const RunFile& run);  ///< (n_blocks); empty: 1 each
/// Pose of a block in the first or last frame; as cut when the run has no frame.
[[nodiscard]] Pose first_pose(const RunFile& run, int block);
[[nodiscard]] Pose last_pose(const RunFile& run, int block);

/// Released = deposited + moving + left, in blocks and in volume [m3].
struct Balance {
  int n_released = 0, n_deposited = 0, n_moving = 0, n_left = 0;
  double released = 0, deposited = 0, moving = 0, left = 0;
};
[[nodiscard]] Balance balance_of(const RunFile& run, double rest_speed);
void add(Balance& sum, const Balance& other);

/// The convex outline of a block in plan at a pose, counter-clockwise [m].
[[nodiscard]] std::vector<Vec2> footprint(const RunFile& run, int block, const Pose& pose);

/// Adds the volume of a block over each cell, exact for its polyhedron: the faces, cut at the
/// cells' sides, are integrated to the vertical with the sign of their slope [m3].
void add_volume(std::map<std::uint32_t, double>& volume, const PassageGrid& grid,
                const RunFile& run, int block, const Pose& pose);

/// Sums over runs for the layer of the deposit.
struct DepositSums {
  std::map<std::uint32_t, double> count;   ///< blocks at rest with their centroid in the cell
  std::map<std::uint32_t, double> weight;  ///< of those
  std::map<std::uint32_t, double> volume;  ///< of all blocks at rest, over the cell [m3]
};
/// Blocks that are displaced by `least` or less since they were cut are left out; below 0: none
/// [m].
void add_deposit(DepositSums& sums, const PassageGrid& grid, const RunFile& run, double rest_speed,
                 double least = -1);
void add(DepositSums& sums, const DepositSums& other);

/// n_deposit, deposit_fraction, deposit_thickness (mean over runs).
[[nodiscard]] MapLayer deposit_layer(const DepositSums& sums, double cell_size,
                                     const ShareBasis& basis);

}  // namespace talus
