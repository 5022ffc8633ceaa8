// libcore/scene/yielding.hpp: public
// Fixed bodies in a run: their properties, their places now, and how they yield.
// in:    the scene's fixed bodies; the pushes of contacts
// out:   deflection, work and breaking of yielding bodies, world by world (YieldingState)
// Fences are one use (scene/fence.hpp), stems of trees another (scene/stems.hpp). All bodies are
// named by their ids.
#pragma once

#include <span>
#include <vector>

#include "geometry/polyhedron.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "scene/worlds.hpp"

namespace talus {

/// One convex body that no block moves. Returns its id. The blocks are all there already.
int add_fixed_body(Scene& scene, const Polyhedron& body, int contact_class);

/// Lets fixed body `body` yield as `how` says (but for its `body`). Returns its number among those
/// that do.
int let_yield(Scene& scene, int body, Yielding how);

/// State of the yielding bodies before anything moves.
[[nodiscard]] YieldingState start_yielding(const Scene& scene);

/// Does fixed body `body` stop anything in `world` (any more)?
[[nodiscard]] bool stands(const Scene& scene, const State& state, int world, int body);

/// Whether any body yields.
[[nodiscard]] inline bool anything_yields(const Scene& scene) {
  return !scene.fixed.yieldings.empty() || !scene.forest.yieldings.empty();
}

/// Number of fixed body `body` among those that yield, -1: it does not.
[[nodiscard]] int yielding_number(const Scene& scene, int body);

/// Where fixed body `body` is now in `world`.
[[nodiscard]] Pose fixed_pose(const Scene& scene, const State& state, int world, int body);

/// Calls visit(body) for the fixed bodies with hulls that have left their first place in `world`.
template <class Visit>
void for_each_shifted(const Scene& scene, const State& state, int world, Visit&& visit) {
  const int n = static_cast<int>(scene.fixed.yieldings.size());
  for (const MetBody& of : state.yielding.worlds[static_cast<std::size_t>(world)]) {
    if (of.yielding >= n) return;  // stems
    if (of.met.deflection != 0 || !of.met.shift.isZero(0))
      visit(scene.fixed.yieldings[static_cast<std::size_t>(of.yielding)].body);
  }
}

[[nodiscard]] const GroundClass& fixed_class(const Scene& scene, int body);

/// How a fixed body yields to a contact with this normal; nullptr: it is rigid. One with an axis
/// yields along it: a block that lands on the upper edge of a fence's panel meets a rigid plate.
[[nodiscard]] const Yielding* giving_way(const Scene& scene, int body, const Vec3& normal);

/// Along which direction it does.
[[nodiscard]] Vec3 yield_direction(const Yielding& yielding, const Vec3& normal);

/// Adds the effect of a contact on a body to the push of its block.
void add_push(const YieldPush& push, std::vector<YieldPush>& pushes);

/// Time within a substep of `h` at which the first body has taken all that it can; infinite when
/// none has. Exact for forces that are constant over the substep.
[[nodiscard]] double time_to_first_break(const Scene& scene, const YieldingState& yielding,
                                         std::span<const YieldPush> pushes, double h);

/// Takes the pushes of an accepted substep that ends at `time` into the bodies; those that are used
/// up break, and blocks that sleep against one wake.
void push_bodies(const Scene& scene, std::span<const YieldPush> pushes, double time, State& state);

}  // namespace talus
