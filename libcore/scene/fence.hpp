// libcore/scene/fence.hpp: public
// Fences: panels between posts, rigid, or yielding at a constant force until their energy is used
// up.
// in:    posts on the ground, height, capacity and deflection; contacts of blocks with panels
// out:   fixed bodies that yield across their line (scene/yielding.hpp), and the hits on them
//
// A panel resists each block with F = capacity / deflection at most and follows the block that
// pushes it farthest; blocks that push at the same time use it up together.
#pragma once

#include <span>
#include <vector>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "scene/yielding.hpp"

namespace talus {

/// A fence line in a run.
struct StandingFence {
  int line = 0;             ///< index of its line among those of the run
  std::vector<Vec3> posts;  ///< feet, local [m]; at least two, no two in a row above each other
  double height = 0;        ///< of the posts, > 0 [m]
  double capacity = Yielding::no_limit;  ///< of a panel, > 0; infinite: rigid [J]
  double deflection = 0;                 ///< at which one block has used up the capacity, > 0 [m]
  std::vector<double> depth;  ///< of a panel below the straight line of its feet [m]  (n_posts - 1)
  GroundClass contact;        ///< friction and, of a rigid panel, restitution
};

/// The plates of the fence's panels, in local coordinates.
[[nodiscard]] std::vector<Polyhedron> panel_plates(const StandingFence& fence);

/// Adds the panels of `fence` to the fixed bodies of the scene, whose blocks are all there already.
void add_fence(Scene& scene, const StandingFence& fence);

/// Number of a fixed body's panel in FixedBodies::panels, -1: it is none.
[[nodiscard]] int panel_number(const Scene& scene, int body);

/// Notes that `block` touched fixed body `body`, a panel, at `point`, having had motion `before` at
/// `time`, and leaves it with motion `after`; data of the first touch stay.
void note_hit(const Scene& scene, int block, int body, const Vec3& point, double time,
              const Motion& before, const Motion& after, FenceState& fence);

/// Adds the work of panels on the blocks that pushed them in an accepted substep to their hits.
void note_work(const Scene& scene, std::span<const YieldPush> pushes, FenceState& fence);

}  // namespace talus
