// libcore/step/substep.hpp: public
// Start of a substep of law talus, for a lone block and for an island: numbers of a block,
// its free motion, and the rows of its contacts with the ground.
// theory 1.7, 1.8 (law of a contact over a step), 1.10 (correction about the free motion)
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "scene/bond_face.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "solver/flips.hpp"
#include "solver/law_numbers.hpp"
#include "solver/newton.hpp"
#include "step/report.hpp"
#include "step/substep_numbers.hpp"
#include "step/work.hpp"

namespace talus {

/// With the stiffness of a lone block.
[[nodiscard]] BlockNumbers numbers_of(const Scene& scene, int b);

/// Gap up to which a contact may come to press within a substep of `h` though the free motion keeps
/// it open [m].
[[nodiscard]] double search_margin(const BlockNumbers& c, double h);

/// Below this approach there is no impact [m/s]. `g`: acceleration of gravity [m/s^2].
[[nodiscard]] double resting_speed(const Settings& settings, double g);
/// Approach of a contact that ends a substep, of a block of which no point is faster than `speed`
/// [m/s]. A slower one closes within the substep, which errs by up to that speed in the block's
/// next motion, and by that times the substep in its place.
[[nodiscard]] double located_speed(const Scene& scene, const BlockNumbers& c, double speed);

/// When a contact that approaches with `speed` < 0 and has `gap` when a substep of `h` begins, and
/// `gap_end` at its end, touches: 0 < time <= h; h + 1 where it does not [s].
[[nodiscard]] double time_to_touch(double gap, double speed, double gap_end, double touch,
                                   double h);

/// The motion of block b from `start` without contact; `pressure` as State has it.
[[nodiscard]] Substep predict(const Scene& scene, int b, const BlockNumbers& c, const Motion& start,
                              double t, double h, std::span<const double> pressure);

/// I + strain of block b.
[[nodiscard]] Mat3 stretch_of(const State& state, int b);

/// Resets the data of a row that are not set anew in every step: memory, bond, and those that
/// solve_contacts keeps while the row waits. Cheaper than a whole new row.
void forget_last_step(ContactRow& row);

/// Begins row `i`, one of the contacts found between block b and the ground: forgets the last step,
/// and sets the bodies that it acts between, in the axes that `to_row` turns local ones into.
[[nodiscard]] ContactRow& begin_row(const Scene& scene, int b, std::size_t i, const Mat3& to_row,
                                    std::span<const Contact> contacts, std::span<ContactRow> rows);
/// Normal velocity and direction of slip of a row whose point begins the substep with `velocity`.
inline void set_start(const Vec3& velocity, ContactRow& row) {
  row.speed_start = row.normal.dot(velocity);
  const Vec3 slip = velocity - row.speed_start * row.normal;
  const double slip_speed = slip.norm();
  row.slip_speed = slip_speed;
  row.slip_start = slip_speed > 0 ? Vec3((1 / slip_speed) * slip) : Vec3(Vec3::Zero());
}

/// The part of memory `index` that a row inherits: the shear spring turned into the new tangent
/// plane, and the overlap that presses nothing. Where the ground below changes plane the gap jumps;
/// the jump does no work. Over one plane, or where both features are those of before, it jumps only
/// by the bend of a turn. `to_row` turns local into the row's axes.
void inherit(const ContactMemory& memory, int index, bool same_features, const Mat3& to_row,
             const BlockNumbers& c, ContactRow& row);

/// Whether a contact that a hit left deep in its other side, and that carries nothing, approaches
/// so fast again that it has to be hit anew: farther in than 2 % of the thickness in a substep of
/// `h`.
[[nodiscard]] bool comes_back_fast(const ContactMemory& memory, double approach, double h,
                                   const BlockNumbers& c);

/// The load that the row of a new contact with body `body_b` takes over from those that press it
/// already, the `memory` of A. Overlap up to that of the deepest of them is expected: where corners
/// of two faces only change places, their load must not be dropped. The stiffness of that one is
/// the new one's last, so that where the stiffness changes in the same step it takes on the force
/// and not the depth.
void take_on_load(std::span<const ContactMemory> memory, int body_b, ContactRow& row);

/// Stiffness, bias and whether the row waits for its impact. `approach`: normal velocity without
/// contact forces, < 0 closing [m/s].
void set_law(const Scene& scene, const BlockNumbers& c, double h, const Mobility& W,
             double approach, ContactRow& row);
/// The same for a contact with the ground.
void set_ground_law(const Scene& scene, const BlockNumbers& c, const Substep& s, ContactRow& row);

/// Takes the contact of an intact bond as one without limit: its load is compared with the strength
/// of its face afterwards.
void hold(const GroundClass& face, double recovery_time, ContactRow& row);

/// The corner of a bonded face of class `face` at a contact that carries `impulse` [N s] over a
/// substep of h [s]. A face is judged by the load that balances inertia; springs lag behind
/// (theory,
/// "Bonds").
[[nodiscard]] BondCorner corner_of(const KeptContact& contact, const GroundClass& face,
                                   const Vec3& impulse, double h);

/// Makes the `rows` of `contacts`, which the search found between block b and the ground, in the
/// body axes of s.R. `memory`: the contact memory of the block.
void make_rows(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
               std::span<const ContactMemory> memory, std::span<const Contact> contacts,
               std::span<ContactRow> rows);

/// Whether a vertex that was above the ground when the substep began ends below another triangle
/// and moves out of its plane: it went through the ridge between them, and would never be hit.
[[nodiscard]] bool came_through_ridge(const Scene& scene, const BlockNumbers& c, const Substep& s,
                                      const Contact& contact, const ContactRow& row);

/// Contacts whose state a substep changed: opened, closed, or from stick to slip or back. `before`
/// is the memory that `rows` started from.
[[nodiscard]] int count_flips(std::span<const ContactRow> rows,
                              const std::vector<ContactMemory>& before);

/// Residual at which the contact forces of a lone block count as found [m/s].
[[nodiscard]] double newton_tolerance(const BlockNumbers& c, const Substep& s);

void add_segment(int b, bool flight, double t, double h, const Motion& start, const Motion& end,
                 std::vector<Segment>& segments);

/// Ends the flight of block b at `t`, not before its local time: its motion is then that at `t`.
void end_flight(const Scene& scene, int b, double t, State& state, Work& work);

/// Decrease in `h` of an overlap that presses nothing: slower than gravity, so nothing hops [m].
[[nodiscard]] inline double offset_relaxed(double gravity, double h) {
  return std::min(law::fastest_relaxing, law::relaxes_by_gravity * gravity * h) * h;
}

/// Counts the steps for which no point of block b has gone farther than contacts resolve: g dt^2,
/// by which its weight presses a block of an island in, or a thousandth of its thickness.
void watch_rest(const Scene& scene, std::size_t b, State& state);
/// Length of the step from state.time on [s].
[[nodiscard]] inline double step_length(const Scene& scene, const State& state) {
  return static_cast<double>(state.stride) * scene.settings.dt;
}
/// Block b is left out until something wakes it; its remaining kinetic energy is booked as lost in
/// contacts.
void fall_asleep(const Scene& scene, std::size_t b, State& state);
/// Kinetic energy of block b in motion `m` [J].
[[nodiscard]] double kinetic_energy(const Scene& scene, std::size_t b, const Motion& m);

/// Whether block b is wholly below the ground under its centroid.
[[nodiscard]] bool is_below_ground(const Scene& scene, int b, const Vec3& centroid);

[[nodiscard]] bool left_ground(const Scene& scene, const Vec3& x);

/// Stops block b where it left the known terrain, and counts it.
void stop_outside(const Scene& scene, int b, State& state, StepReport& report);

[[nodiscard]] bool is_finite(const Motion& m);

/// Stops block b, whose numbers failed, at its last good state, and flags it.
void stop_at(const Motion& last_good, std::size_t b, State& state, StepReport& report);

/// Keeps the accelerations of the substep, the first guess of the next: their running mean since
/// something presses the block.
void set_rates(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
               const Motion& end, State& state);
/// After a hit the last accelerations say nothing about the next, and an unsupported block falls.
void forget_rates(const Scene& scene, int b, State& state);

/// Keeps by how much the ground accelerated block b [m/s2], up to the support of its weight.
void set_support(const Scene& scene, int b, const Vec3& acceleration, State& state);

}  // namespace talus
