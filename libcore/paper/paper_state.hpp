// libcore/paper/paper_state.hpp: public
// Numbers that only law paper needs, and its state from step to step.
#pragma once

#include <vector>

#include "base/types.hpp"

namespace talus {

struct PaperSettings {
  bool post_adjustment = true;  ///< restitution by (28); off, that of the springs
};

struct PaperState {
  std::vector<Vec3> rebound;  ///< v_a of the current impact, (28) [m/s] (n_blocks)
};

}  // namespace talus
