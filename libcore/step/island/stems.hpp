// libcore/step/island/stems.hpp
// Stems of a forest in the search of an island: which are near a block, and where they touch it.
#pragma once

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/island/data.hpp"

namespace talus {

/// Whether block `b`, which a ball of `reach` about `at` holds until the end of the step, touches
/// no stem within it.
[[nodiscard]] bool is_far_from_stems(const Scene& scene, const State& state, int b, const Vec3& at,
                                     double reach, PairSearch& search);

/// Appends to the pairs found those of the blocks that are awake with the stems within `margin` and
/// their motion ahead.
void add_stem_pairs(const Scene& scene, const State& state, double margin, PairSearch& search);

/// How often as short as planned a substep has to be, so that no point of the block of `m`, a pair
/// with a stem, goes past the side of the stem that it was found at.
[[nodiscard]] double part_by_stem(const Scene& scene, const PairSearch& search,
                                  const PairManifold& m, double thickness);

/// Whether contact `r` presses on a stem that its block ran into: the stem moves with the block
/// until that stops, and does not throw it back.
[[nodiscard]] bool follows_block(const Scene& scene, const IslandMembers& members,
                                 const IslandSystem& system, std::size_t r);

/// Time within a substep of `h` at which the first stem has stopped a block that runs into it,
/// infinite when none has: the work of the stem at its limit until then is all of its work.
[[nodiscard]] double time_to_stop(const Scene& scene, const IslandMembers& members,
                                  const IslandSystem& system, double h);

}  // namespace talus
