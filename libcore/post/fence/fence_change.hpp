// libcore/post/fence/fence_change.hpp
// Changes by a fence on the ground: where the mass comes to rest and how fast it passes.
// in:    runs with the fence and runs without it, on one grid of passages
// out:   a map of differences, with minus without; volumes
// paper: Zhang et al. 2018, Fig. 14
#pragma once

#include <span>

#include "post/deposit.hpp"
#include "post/maps/maps.hpp"

namespace talus {

/// Sums over runs that are on one side of the comparison.
struct GroundSums {
  int n_runs = 0;
  DepositSums deposit;
  std::map<std::uint32_t, float> speed;  ///< largest of any block and run over the cell [m/s]
};
void add_run(GroundSums& sums, const PassageGrid& grid, const RunFile& run, double rest_speed);
/// Passages of a run that add_run() did not have.
void add_speeds(GroundSums& sums, std::span<const Passage> passages);

/// Layer fence_change with the bands deposit_thickness_change (means over runs) and
/// velocity_max_change; 0 where neither side has anything.
[[nodiscard]] MapLayer change_layer(const GroundSums& with, const GroundSums& without,
                                    double cell_size);

/// Volume of the deposit, a run [m3].
struct DepositChange {
  double with = 0, without = 0;
  double more = 0, less = 0;  ///< sums over cells that hold more, and less, with the fence; >= 0
};
[[nodiscard]] DepositChange deposit_change(const GroundSums& with, const GroundSums& without);

}  // namespace talus
