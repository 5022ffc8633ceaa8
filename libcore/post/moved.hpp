// libcore/post/moved.hpp: public
// How much of the released mass moved, and how far: no number of a single block tells it.
// in:    first and last pose of each block
// out:   shares of the mass, percentiles of the displacement by mass
#pragma once

#include <string>
#include <vector>

#include "base/percentile.hpp"
#include "record/run_file.hpp"

namespace talus {

inline constexpr double moved_m = 1;        ///< a block displaced by more has moved [m]
inline constexpr double moved_far_m = 20;   ///< [m]
inline constexpr double event_share = 0.1;  ///< of the mass that moves in an event
inline constexpr double least_moved = 0.5;  ///< share of the mass that makes most of it

/// Displacement: straight from a centroid's place at the start to that at the end, in space.
struct Moved {
  double mass = 0;                   ///< released [kg]; of rocks one by one their number
  bool of_rocks = false;             ///< shares are of rocks that fell one by one, not of a mass
  double share = 0;                  ///< of the mass, displaced by more than moved_m [-]
  double share_far = 0;              ///< displaced by more than moved_far_m [-]
  double p50 = 0, p90 = 0, p95 = 0;  ///< displacement that this share of the mass stays below [m]
  double largest = 0;                ///< of any block [m]
  [[nodiscard]] bool any() const { return largest > moved_m; }  ///< a block moved
  /// Enough of the mass moved to call it one; else single blocks fell, or none.
  [[nodiscard]] bool is_event() const { return share >= event_share; }
};
/// NaN without mass.
[[nodiscard]] Moved moved_of(std::vector<WeightedValue> displacement_and_mass,
                             bool of_rocks = false);
/// Of one run.
[[nodiscard]] Moved moved_of_run(const RunFile& run);

/// Weights of the blocks of a run in shares: their mass [kg]; one each where rocks fell one by one.
[[nodiscard]] std::vector<double> counted_by(const RunFile& run);  //               (n_blocks)

/// Displacement [m] of each block of a run, and its weight                       (n_blocks)
[[nodiscard]] std::vector<WeightedValue> displacements(const RunFile& run);

/// "28 % of the mass moved more than 1 m, 12 % more than 20 m; displacement by mass: p50 0.1 m, p90
/// 45 m, p95 60 m"
[[nodiscard]] std::string text(const Moved& moved);

/// Message when less than half of the mass moved; "" else.
[[nodiscard]] std::string standing_mass_warning(const Moved& moved);

}  // namespace talus
