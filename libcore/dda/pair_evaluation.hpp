// libcore/dda/pair_evaluation.hpp
// What an evaluation of the contact law over lanes takes and gives for a pair of bodies.
#pragma once

#include <cstdint>
#include <span>

#include "dda/island.hpp"

namespace talus {

/// How contacts are evaluated: with the states they came with and friction bounded by the last
/// step's normal impulses (a bound from the predicted overlap has no limit), a new contact and one
/// that would pull more than it pressed by the law; or all with the law.
enum class Evaluation : std::uint8_t { inherited, coupled };

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
