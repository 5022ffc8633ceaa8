// libcore/run/probe.hpp: public
// The first seconds of a run, to see what of the mass goes before all of it is computed.
// in:    a Scene with a coarse time step
// out:   how far each block came, and the share of the mass that moved
//
// On thirteen masses of real slopes the share that moved more than 0.1 m in 3 s at 10 ms forecast
// the share that moved more than 1 m by the end to 0.06 (rms), at worst 0.16. What loosens slowly
// it does not see.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace talus {

inline constexpr double probe_step_s = 0.01, probe_moved_m = 0.1;

struct Probe {
  double time = 0;                   ///< computed [s]
  std::vector<double> displacement;  ///< of each block's centroid [m]             (n_blocks)
  double moved_share = 0;            ///< of the mass, by more than probe_moved_m [-]
  double largest_speed = 0;          ///< of a centroid at the end [m/s]
  std::string fault;                 ///< the limit of health that ended it; empty: none
};

/// `duration` [s]. `is_stopped` is asked now and then; true ends the probe where it is.
[[nodiscard]] Probe probe(const Scene& scene, double duration,
                          const std::function<bool(double share)>& is_stopped = {});

}  // namespace talus
