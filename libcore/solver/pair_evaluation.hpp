// libcore/solver/pair_evaluation.hpp
// Input and result of evaluating the contact law over lanes for a pair of bodies.
#pragma once

#include <span>

#include "solver/island.hpp"

namespace talus {

/// A pair to evaluate.
struct PairEvaluation {
  std::span<RowGroup> groups;
  Vec6 motion;           ///< u
  Two sum[6];            ///< out: of the impulses, as generalised ones on A about its centroid
  bool changed = false;  ///< out: a tangent did

  [[nodiscard]] Vec6 impulse() const {
    Vec6 f;
    for (int k = 0; k < 6; ++k) f[k] = sum[k][0] + sum[k][1];
    return f;
  }
};

}  // namespace talus
