// libcore/step/lone/lone_soil.hpp
// Law talus, one block: where step/soil.hpp comes in over a substep. Axes are those of the rows.
#pragma once

#include <algorithm>
#include <span>

#include "solver/newton.hpp"
#include "step/lone/lone_substep.hpp"
#include "step/soil.hpp"
#include "step/substep_numbers.hpp"
#include "step/work.hpp"

namespace talus {

/// Couples, friction and drag of the ground for the rows that are made.
inline void begin_soil(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
                       const State& state, double t, Work& work) {
  SoilWork& soil = work.soil;
  soil.turns.clear();
  soil.arms.clear();
  (void)begin_soil(scene, b, c, s.h, slide_of(state, b, t), work.rows, soil.turns, soil.arms);
  soil.varies = std::any_of(work.rows.begin(), work.rows.end(), [&](const ContactRow& row) {
    return varies_friction(class_of(scene, row));
  });
}

/// Mean speed of slip of a row over the substep that was solved [m/s].
template <int Dof>
[[nodiscard]] double mean_slip(const BlockSystem<Dof>& system, const ContactRow& row) {
  const Vec3 end = point_velocity<Dof>(system.velocity, row.arm) + row.drift;
  return (row.slip_speed + (end - row.normal.dot(end) * row.normal).norm()) / 2;
}

/// Friction of the rows that slip, over the substep that was solved.
template <int Dof>
void renew_friction(const Scene& scene, int b, const Substep& s, const State& state, double t,
                    const BlockSystem<Dof>& system, Work& work) {
  for (ContactRow& row : work.rows)
    if (!row.waits && row.state == ContactState::slip)
      vary_friction(class_of(scene, row), slide_of(state, b, t), mean_slip(system, row), s.h,
                    row.friction);
}

/// Solves the contacts by `solve()` with the couples and friction of the ground.
template <int Dof, class Solve>
NewtonResult solve_on_soil(const Scene& scene, int b, const Substep& s, const State& state,
                           double t, BlockSystem<Dof>& system, Work& work, Solve&& solve) {
  system.angular = work.soil.turns;
  system.arms = work.soil.arms;
  const NewtonResult result = solve();
  if (!work.soil.varies || !result.converged) return result;
  renew_friction(scene, b, s, state, t, system, work);
  const NewtonResult again = solve();
  return {again.converged, result.passes + again.passes};
}

/// Turn of the free motion whose cross product with a point's lever in the middle of the substep is
/// the path of that point: axes of the body, at its start as at its end [rad].
[[nodiscard]] inline Vec3 turn_of_levers(const Substep& s) {
  const Quat by = s.start.pose.attitude.conjugate() * s.free.pose.attitude;
  return 2 / by.w() * by.vec();
}

/// Books the work of couples, along the turn on which contacts do theirs (a mean of spins misses
/// some of the turn that contacts add), and the slip distance of the contact that presses most.
template <int Dof>
void end_soil(const Scene& scene, int b, const Substep& s, double t, const BlockSystem<Dof>& system,
              const Solved<Dof>& solved, const Work& work, State& state) {
  for (const AngularRow& turn : work.soil.turns)
    state.ledger.rolling -= turn.couple.dot(turn_of_levers(s) + solved.turn) / s.h;
  if (!work.soil.varies || state.slid.empty()) return;
  double most = 0;
  const ContactRow* pressed = nullptr;
  for (const ContactRow& row : work.rows) {
    if (row.waits || row.state == ContactState::open) continue;
    const double p_n = row.normal.dot(row.impulse);
    if (p_n > most) most = p_n, pressed = &row;
  }
  if (pressed == nullptr) return;
  const double speed = pressed->state == ContactState::slip ? mean_slip(system, *pressed) : 0;
  slide_on(scene, class_of(scene, *pressed), b, speed, s.h, t, s.h, state);
}

}  // namespace talus
