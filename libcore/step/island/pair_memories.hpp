// libcore/step/island/pair_memories.hpp
// Which memory of the last step each point of a manifold continues.
#pragma once

#include <span>
#include <vector>

#include "contact/contact.hpp"
#include "contact/manifold.hpp"

namespace talus {

struct PairMemories {
  int touched_by = -1;         ///< block whose memories `touched` is of
  std::vector<int> touched;    ///< body B of each memory
  std::vector<int> continued;  ///< memory that a manifold's point continues, -1: none
  std::vector<int> unclaimed;  ///< memories of the pair that no point continues yet
};

/// Of one pair of bodies, whatever the keys say of them.
[[nodiscard]] inline bool has_features(const ContactKey& now, const ContactKey& then) {
  return now.mode == then.mode && now.feature_a == then.feature_a &&
         now.feature_b == then.feature_b;
}

/// Fills `continued` for the `points` of manifold `m` with body `other`, so named in ContactKey;
/// `memory` is that of its block A. First the memories of the same features; then, where features
/// changed, those that the pair leaves without a successor, so that a face that rests on another
/// keeps its support and its friction while corners pass edges. Manifolds come block by block; a
/// new step begins with `touched_by` = -1.
void match_memories(const PairManifold& m, int other, std::span<const PairPoint> points,
                    std::span<const ContactMemory> memory, PairMemories& out);

}  // namespace talus
