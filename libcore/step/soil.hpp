// libcore/step/soil.hpp
// Effects of yielding ground on a block: couples against rolling and pivoting, friction that
// follows the slid distance or the speed, drag; and the drag of forests. Nothing is computed where
// no class of ground and no forest asks for it.
// in:    classes of ground, rows of a block's contacts with it
// out:   angular rows, friction of the rows, motions after drag
// theory 1.13; docs/reference/site-file.md
#pragma once

#include <span>
#include <vector>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "solver/angular_row.hpp"
#include "solver/contact_row.hpp"
#include "solver/impact_solve.hpp"
#include "step/substep_numbers.hpp"

namespace talus {

/// The class of ground that a contact is with.
[[nodiscard]] inline const GroundClass& class_of(const Scene& scene, const KeptContact& contact) {
  return scene.ground.classes[static_cast<std::size_t>(contact.ground_class)];
}

/// Arms of the couples on `ground` of block b: mu_r R_e and mu_s R_e with R_e the radius of the
/// sphere of its volume.
[[nodiscard]] RowArm arm_on(const Scene& scene, const GroundClass& ground, int b);

/// The dent that a hit of block b makes in `ground`.
[[nodiscard]] Dent dent_on(const Scene& scene, const GroundClass& ground, int b);

/// Damping of the couple over a step of `h`: as firm as the stiffest contact of a lone block
/// [kg m2].
[[nodiscard]] double turn_damping(const Scene& scene, const BlockNumbers& c, double h);

/// Adds the angular row of block b beside `rows`, and the arms of these, where one of them is on
/// ground that resists rolling. `arms` and `turns` grow; returns the row's index, -1: none.
int add_turn(const Scene& scene, int b, const BlockNumbers& c, double h,
             std::span<const ContactRow> rows, std::vector<AngularRow>& turns,
             std::vector<RowArm>& arms);

/// Slip distance on ground whose friction follows it: less the part forgotten off the ground [m].
[[nodiscard]] double slip_distance(const Slide& slide, const GroundClass& ground);

/// The one place that friction comes from where it varies, for every solver: makes `friction` its
/// mean over a `time` of slip at the mean speed `speed`; 0: at that speed now. Leaves it where it
/// does not vary.
void vary_friction(const GroundClass& ground, const Slide& slide, double speed, double time,
                   double& friction);

/// The same between blocks at slip `speed`: there it follows the speed alone.
inline void weaken_friction(const GroundClass& faces, double speed, double& friction) {
  if (weakens(faces)) friction = friction_on(faces, speed, 0);
}

/// The block slides for a further `time` at the mean speed `speed`, to the end of a substep of `h`
/// from t. A sticking contact creeps: that is not slid.
void slide_on(const Scene& scene, const GroundClass& ground, int b, double speed, double time,
              double t, double h, State& state);

/// Rows of block b with the ground that are made: adds their angular row, as add_turn(), and makes
/// their friction that at the speed of the start.
int begin_soil(const Scene& scene, int b, const BlockNumbers& c, double h, const Slide& slide,
               std::span<ContactRow> rows, std::vector<AngularRow>& turns,
               std::vector<RowArm>& arms);

/// The straight displacement of a block's centroid in half of a substep. The two halves follow on
/// each other, so that a border that the block crosses counts where it is.
struct HalfWay {
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  ///< [m]
};
/// The halves of a substep of `h` from the motion before drag, and that which ends at `end`.
[[nodiscard]] inline HalfWay first_half(const Motion& start, double h) {
  return {start.pose.position, start.pose.position + h / 2 * start.velocity};
}
[[nodiscard]] inline HalfWay second_half(const Motion& start, double h, const Motion& end) {
  return {first_half(start, h).to, end.pose.position};
}

/// `motion` of block b after drag for a time of `h`, in which it moves along `half`: of the ground
/// below it where it `is_pressed` on that, and of the forests around it, which leave its spin;
/// exact for each alone.
[[nodiscard]] Motion after_drag(const Scene& scene, int b, const Motion& motion,
                                const HalfWay& half, bool is_pressed, double h);

/// Whether a class of ground or a forest drags.
[[nodiscard]] bool any_drags(const Scene& scene);

}  // namespace talus
