// libcore/site/plausibility.hpp: public
// Numbers of a site that are valid but most likely mistakes.
// in:    measures of the source, its blocks and the time that they need
// out:   doubts, each with the key to change
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "base/doubt.hpp"

namespace talus {

/// Steps at the foot below this many spacings are low for the blocks.
inline constexpr double low_step_spacings = 0.3;

/// NaN where a number does not apply.
struct PlausibilityFacts {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double polygon_area = none;                  ///< [m2]
  double mean_depth = none, max_depth = none;  ///< of the mass, vertical [m]
  std::string depth_key = "source.depth_m";    ///< that sets the depth
  double relief = none;                        ///< of the ground over the mass [m]
  double normal_depth = none;                  ///< depth_m, where it counts along the normal [m]
  double width = none;                         ///< shorter extent of the source [m]
  double terrain_area = none;                  ///< known ground [m2]
  double cell_size = none;                     ///< [m]
  double smallest_spacing = none;              ///< of the joint sets [m]
  double n_blocks = none;                      ///< that a run would move
  bool daylights = false;                      ///< the surface is a plane or wedge that comes out
  double step_at_foot = none;                  ///< largest height that the mass leans on [m]
  double step_share = none;                    ///< of the foot with a step that counts [-]
  double sliding_spacing = none;               ///< of the set that slides [m]
  double duration = none;                      ///< of the run [s]
  double travel_duration = none;  ///< that points that slide from the source ask for [s]
  double moved_share = none;      ///< of the mass in the probe [-]
  double left_share = none;       ///< of the fall lines that leave the terrain [-]
  double largest_rock = none;     ///< of those that fall one by one [m3]
  std::string frequency_key;      ///< that says how often the mass goes as a whole
  double frequency = none;        ///< [1/a]
  struct Fence {
    std::string section;
    double height = none, capacity = none;  ///< [m], [kJ]
  };
  std::vector<Fence> fences;
};

/// In a fixed order, of the keys that change them. Limits: docs/tools/talus-check.md
[[nodiscard]] std::vector<Doubt> doubts_of(const PlausibilityFacts& facts);

/// Result of the probe for the whole mass.
enum class Outlook { stands, goes_in_part, goes };
[[nodiscard]] Outlook outlook_of(double moved_share);
[[nodiscard]] const char* text(Outlook outlook);

/// Processor time of a run of blocks in contact [s], from runs of masses on real slopes; how far
/// off it was there: docs/evidence/measurements.md. `dt`: time step [s].
[[nodiscard]] double expected_cpu_s(double n_blocks, double duration, double dt);
/// Of one simulated second while all blocks are in contact [s].
[[nodiscard]] double cpu_s_of_a_packed_second(double n_blocks, double dt);
/// Of rocks that fall one by one, each until it rests.
[[nodiscard]] double expected_cpu_s_alone(double n_rocks);
/// The same run, from the time that a probe of it took: `probe_cpu` for `probe_duration` at
/// `probe_dt` [s].
[[nodiscard]] double scaled_cpu_s(double probe_cpu, double probe_duration, double probe_dt,
                                  double duration, double dt);

}  // namespace talus
