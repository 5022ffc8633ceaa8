// libcore/run/batch_scene.hpp
// A scene of some of the rocks of another one, for rocks that fall one by one.
// in:    the scene of all rocks
// out:   the same ground, fixed bodies and settings, and a few rocks
#pragma once

#include "blocks/block_set.hpp"
#include "scene/scene.hpp"

namespace talus {

/// The scene without rocks, and the parts that belong to a rock left empty.
[[nodiscard]] Scene without_rocks(const Scene& scene);

/// Puts rocks [first, end) of `scene` into `batch` (of without_rocks), in the place of those there.
/// Their surfaces are made of the blocks of `surfaces`; null: they are in the scene.
void take_rocks(const Scene& scene, const BlockSet* surfaces, int first, int end, Scene& batch);

}  // namespace talus
