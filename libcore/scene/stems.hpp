// libcore/scene/stems.hpp: public
// Stems of a forest in a scene: their numbers among the fixed bodies, and hits on them.
// in:    stems on the ground; contacts of blocks with them
// out:   Scene::forest; hits
// ref:   Dorren and Berger 2006 (energy that breaks a stem)
//
// As fixed bodies the stems follow those with hulls: stem s is body n_fixed + s.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/state.hpp"

namespace talus {

[[nodiscard]] inline int n_stems(const Scene& scene) {
  return static_cast<int>(scene.forest.stems.size());
}
/// Is fixed body `body` a stem?
[[nodiscard]] inline bool is_stem(const Scene& scene, int body) { return body >= n_fixed(scene); }
[[nodiscard]] inline int stem_of(const Scene& scene, int body) { return body - n_fixed(scene); }
[[nodiscard]] inline int body_of_stem(const Scene& scene, int stem) {
  return stem + n_fixed(scene);
}

/// Energy that breaks a stem of this diameter at breast height, FE 38.7 DBH^2.31 with DBH in
/// centimetres [J]. `factor`: FE, by the species.
[[nodiscard]] double stem_capacity(double factor, double dbh_m);

/// Adds stems to a scene whose blocks and fixed bodies are all there. `faces`: of each section.
void add_forest(Scene& scene, std::vector<Stem> stems, std::vector<GroundClass> faces);

/// State of stem `stem` in a world (YieldingState); that at the start where nothing pushed it.
[[nodiscard]] const Yielded& met_by_stem(const Scene& scene, const State& state, int world,
                                         int stem);

/// Where the axis of `stem` is now in `world`, local x, y [m].
[[nodiscard]] Vec2 axis_of_stem(const Scene& scene, const State& state, int world, int stem);

/// Notes that `block` touches fixed body `body`, a stem, at `point`, having had motion `before` at
/// `time`, and leaves it with motion `after`; data of the first touch stay.
void note_stem_touch(const Scene& scene, int block, int body, const Vec3& point, double time,
                     const Motion& before, const Motion& after, State& state);

/// Adds the work of stems on the blocks that pushed them in an accepted substep to their hits.
void note_stem_work(const Scene& scene, std::span<const YieldPush> pushes, State& state);

}  // namespace talus
