// libcore/paper/paper_state.hpp: public
// What law paper alone asks for, and what it alone carries from step to step.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

struct PaperSettings {
  bool post_adjustment = true;  ///< restitution by (28); off, that of the springs
};

struct PaperState {
  std::vector<Vec3> rebound;  ///< v_a of the hit under way, (28) [m/s] (n_blocks)
};

}  // namespace talus
