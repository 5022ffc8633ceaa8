// libcore/run/probe.hpp: public
// The first seconds of a run, to see which share of the mass goes before all of it is computed.
// in:    a Scene with a coarse time step
// out:   how far each block came, and the share of the mass that moved
//
// A block goes when it has moved 1 m, or would at its speed within another 1.5 s: a block that sags
// onto a step at the foot comes to rest before that. In 28 runs on real slopes the share that goes
// by this rule after 4 s equalled the share that moved more than 1 m by the end to 0.05 (rms), at
// worst 0.20; after 3 s, with another 3 s ahead, to 0.09, at worst 0.39: a hollow sagged by 0.6 to
// 1.4 m and was taken for one that goes. The probe does not see blocks that loosen slowly.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace talus {

inline constexpr double probe_step_s = 0.01;                    // of the engine
inline constexpr double probe_goes_m = 1, probe_ahead_s = 1.5;  // when a block goes

struct Probe {
  double time = 0;                   ///< computed [s]
  std::vector<double> displacement;  ///< of each block's centroid [m]             (n_blocks)
  std::vector<bool> goes;            ///< whether it goes                          (n_blocks)
  double moved_share = 0;            ///< of the mass that goes [-]
  double largest_speed = 0;          ///< of a centroid at the end [m/s]
  std::string fault;                 ///< the limit of health that ended it; empty: none
};

/// `duration` [s]. `is_stopped` is asked now and then; true ends the probe where it is.
[[nodiscard]] Probe probe(const Scene& scene, double duration,
                          const std::function<bool(double share)>& is_stopped = {});

}  // namespace talus
