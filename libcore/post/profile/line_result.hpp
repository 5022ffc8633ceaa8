// libcore/post/profile/line_result.hpp: public
// Statistics across and along a line that was drawn after the runs.
// in:    crossings and passages of all runs (line_sums.hpp)
// out:   crossings, for the whole line and by chainage; ground and envelope at stations
#pragma once

#include <string>
#include <vector>

#include "post/fence/fence_summary.hpp"
#include "post/profile/line_sums.hpp"
#include "post/share_interval.hpp"

namespace talus {

/// Crossings of a part of the line.
struct AcrossSummary {
  double from = 0, to = 0;      ///< chainage [m]
  FencePartSummary blocks;      ///< number, energy, speed, height of the top above the ground
  int n_runs_hit = 0;           ///< runs in which any block crosses
  double share_of_runs = 0;     ///< by the runs' weights [-]
  Interval interval_of_runs;    ///< 95 %; NaN: too few runs
  double a_run = 0;             ///< blocks, mean over the runs by their weights
  double share_of_blocks = 0;   ///< of the released blocks, by weight [-]
  Interval interval_of_blocks;  ///< 95 %; NaN: too few clusters
  double mass_a_run = 0;        ///< mean over the runs by their weights [kg]
  double share_of_mass = 0;     ///< of the released mass [-]
  double first_arrival = 0;     ///< NaN: nothing crosses [s]
};

/// Chainages from which to which blocks count together: `length` long, the last as long as is left.
/// NaN: 1, 2 or 5 times a power of ten, so that there are 10 to 25.
[[nodiscard]] std::vector<double> bin_limits(double line_length, double length);

/// Of the crossings from `from` to before `to`; a last limit takes those on it, too.
[[nodiscard]] AcrossSummary across_summary(const LineSums& sums, const ShareBasis& basis,
                                           double from, double to);

/// One quantity of the blocks that pass a station; NaN: none, and p95 of fewer than 59.
struct Envelope {
  double p50 = 0, p95 = 0, largest = 0;
};
/// The line at a station.
struct StationSummary {
  double chainage = 0;          ///< [m]
  Vec3 place = Vec3::Zero();    ///< on the ground, local [m]
  int n_blocks = 0;             ///< that came over its cell, all runs
  double share_of_runs = 0;     ///< with passages, by weight; NaN: none has any [-]
  Envelope energy, speed, top;  ///< with rotation [J]; [m/s]; above the ground [m]
};
[[nodiscard]] std::vector<StationSummary> station_summaries(const LineSums& sums,
                                                            const ShareBasis& basis);

/// Change of energy between the two frames about a crossing, over the energy at it: a bound that
/// the error of that energy mostly stays below.
struct EnergyChange {
  double p50 = 0, p95 = 0;  ///< over crossings by frames [-]; NaN: there are none
};
[[nodiscard]] EnergyChange energy_change(const LineSums& sums);

/// "frames", "cells" or "frames and cells".
[[nodiscard]] std::string method_text(const LineSums& sums);

}  // namespace talus
