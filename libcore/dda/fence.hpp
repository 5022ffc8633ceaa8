// libcore/dda/fence.hpp
// Fences that stand in the way: panels between posts, rigid, or giving way at a constant force
// until their energy is used up.
// in:    posts on the ground, height, capacity and deflection; contacts of blocks with panels
// out:   fixed bodies; deflection, work and breaking of panels, and what hit them
//
// A panel that gives way is a rigid plate on a plastic brake, without mass: it resists each block
// with F = capacity / deflection at most, follows the block that pushes it farthest, and stays
// where it was pushed. Its work is the sum of F times the way that each block pushes it, so blocks
// that push at the same time use it up together; at `capacity` it breaks and is gone.
#pragma once

#include <span>
#include <vector>

#include "dda/scene.hpp"
#include "dda/state.hpp"

namespace talus {

/// A fence line as it stands in a run.
struct StandingFence {
  int line = 0;             ///< index of its line among those of the run
  std::vector<Vec3> posts;  ///< feet, local [m]; at least two, no two in a row above each other
  double height = 0;        ///< of the posts, > 0 [m]
  double capacity = FencePanel::no_limit;  ///< of a panel, > 0; infinite: rigid [J]
  double deflection = 0;                   ///< at which one block has used up the capacity, > 0 [m]
  std::vector<double> depth;  ///< of a panel below the straight line of its feet [m]  (n_posts - 1)
  GroundClass contact;        ///< friction and, of a rigid panel, restitution
};

/// The plates of the fence's panels, in local coordinates.
[[nodiscard]] std::vector<Polyhedron> panel_plates(const StandingFence& fence);

/// Adds the panels of `fence` to the fixed bodies of the scene, whose blocks are all there already.
void add_fence(Scene& scene, const StandingFence& fence);

/// One convex body that no block moves. Returns its number among the fixed bodies.
int add_fixed_body(Scene& scene, const Polyhedron& body, int contact_class, int panel = -1);

/// What panels have met before anything moves.
[[nodiscard]] FenceState start_fence(const Scene& scene);

/// Does fixed body `body` stop anything (any more)?
[[nodiscard]] bool stands(const Scene& scene, const State& state, int body);

/// Where fixed body `body` is now.
[[nodiscard]] Pose fixed_pose(const Scene& scene, const State& state, int body);

[[nodiscard]] const GroundClass& fixed_class(const Scene& scene, int body);

/// Index of a fixed body's panel in FixedBodies::panels, -1: it is none.
[[nodiscard]] int panel_number(const Scene& scene, int body);

/// Panel of a fixed body that gives way to a contact with this normal; nullptr: it is rigid. Panels
/// give way across their line: what lands on their upper edge meets a rigid plate.
[[nodiscard]] const FencePanel* giving_way(const Scene& scene, int body, const Vec3& normal);

/// Takes what a contact did to a panel into the push of its block.
void add_push(const PanelPush& push, std::vector<PanelPush>& pushes);

/// Time within a substep of `h` at which the first panel has taken all that it can; infinite when
/// none has. Exact for forces that are constant over the substep.
[[nodiscard]] double time_to_first_break(const Scene& scene, const FenceState& fence,
                                         std::span<const PanelPush> pushes, double h);

/// Takes the pushes of an accepted substep that ends at `time` into the panels; those that are used
/// up break, and blocks that sleep against one wake.
void push_panels(const Scene& scene, std::span<const PanelPush> pushes, double time, State& state);

/// Notes that `block` touched panel body `body` at `point`, having had motion `before` at `time`,
/// and leaves it with motion `after`; what is known from the first touch stays.
void note_hit(const Scene& scene, int block, int body, const Vec3& point, double time,
              const Motion& before, const Motion& after, FenceState& fence);

}  // namespace talus
