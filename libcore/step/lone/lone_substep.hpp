// libcore/step/lone/lone_substep.hpp
// Law talus: the equations of one substep of one block, and its memory for the next.
// in:    the predicted substep and the rows of its contacts
// out:   the system that newton.hpp solves, the motion at the end, contact memory
// theory: 1.8, 1.10; docs/developing/design-notes.md
#pragma once

#include <algorithm>
#include <cmath>

#include "motion/displacement.hpp"
#include "motion/rotation.hpp"
#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "solver/newton.hpp"
#include "step/deep_blocks.hpp"
#include "step/loads.hpp"
#include "step/substep.hpp"
#include "step/work.hpp"

namespace talus {

/// Rows of the contacts that the search left in `work.contacts`, of block b with the ground.
/// `memory`: the contact memory of the block.
inline void make_rows(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
                      std::span<const ContactMemory> memory, Work& work) {
  work.rows.resize(work.contacts.size());
  make_rows(scene, b, c, s, memory, work.contacts, work.rows);
}

/// Momentum of the free motion, masses, and the first guess of the velocity at the end: the last
/// acceleration continues.
template <int Dof>
BlockSystem<Dof> make_system(const Scene& scene, int b, const BlockNumbers& c, const Substep& s,
                             const State& state) {
  const auto i = static_cast<std::size_t>(b);
  BlockSystem<Dof> system;
  const Vec3 v_free = s.R.transpose() * s.free.velocity;
  const Vec3 v_guess = s.R.transpose() * (s.start.velocity + s.h * state.acceleration[i]);
  const Vec3 spin_guess = s.spin_start + s.h * state.spin_rate[i];
  if constexpr (Dof == 6) {
    system.mass.setZero();
    system.mass.diagonal() << Vec3::Constant(c.mass), c.inertia;
    system.free_velocity << v_free, s.spin_free;
    system.velocity << v_guess, spin_guess;
  } else {
    const Blocks& blocks = scene.blocks;
    const double volume = blocks.volume[i];
    const Mat6 C = elastic_matrix(blocks.young[i], blocks.poisson[i]);
    Vec6 stress = C * state.strain[i];
    if (!blocks.initial_stress.empty()) stress += blocks.initial_stress[i];
    Vec12 momentum;
    system.mass = mass_matrix(c.mass / volume, volume, blocks.second_moment[i].asDiagonal());
    Vec12 v;
    v << v_free, s.spin_free, state.strain_rate[i];
    // the angular momentum is that of the turning and of the straining together
    v.segment<3>(3) -=
        c.inverse_inertia.cwiseProduct(system.mass.template block<3, 6>(3, 6) * v.tail<6>());
    momentum = system.mass * v;
    momentum.template tail<6>() -= s.h * volume * stress;
    momentum.template tail<6>() +=
        s.h * load_strain(scene, b, s.free.pose.attitude, state.pressure);
    system.mass.template bottomRightCorner<6, 6>() += s.h * c.recovery_time * volume * C;
    system.free_velocity = system.mass.ldlt().solve(momentum);
    system.velocity = system.free_velocity;
    system.velocity.template head<6>() << v_guess, spin_guess;
  }
  system.tolerance = scene.settings.tolerance_factor * newton_tolerance(c, s);
  return system;
}

/// Motion at the end of the substep: the free one corrected by the change by contacts, with the
/// acceleration constant over the substep, D = h (v + v') / 2 (theory 1.8, beta = 1/2).
template <int Dof>
struct Solved {
  Motion end;
  Vec6 change = Vec6::Zero();    // of velocity by contact, body axes
  Vec3 turn = Vec3::Zero();      // by contact, body axes [rad]
  Mat3 strained = Mat3::Zero();  // twice the mean strain rate, body axes
  /// Displacement of a body point by contact and by straining, body axes.
  [[nodiscard]] Vec3 moved(const Vec3& X, double h) const {
    const Vec3 by_contact = h / 2 * change.template head<3>() + turn.cross(X);
    if constexpr (Dof == 6) return by_contact;
    return by_contact + h / 2 * (strained * X);
  }
};

/// Turn of a body by the change `spin` of its spin in the middle of a time of 2 `half`, body axes
/// at its end: `half` times that but for the effect of the body's own spin on it. A change of
/// momentum stays fixed in space while the axes turn past it, and the turn that it has caused
/// changes the spin again. Without it a fast top nutates too slowly by a part of (spin h)^2.
inline Vec3 turn_by_change(const BlockNumbers& c, const Vec3& body_spin, const Vec3& spin,
                           double half) {
  const Vec3 change = c.inertia.cwiseProduct(spin),
             momentum = c.inertia.cwiseProduct(body_spin) + change;
  const Vec3 again =
      c.inverse_inertia.cwiseProduct(body_spin.cross(change) + momentum.cross(spin)) -
      body_spin.cross(spin);
  return half * (spin + half / 2 * again);
}

template <int Dof>
Solved<Dof> solved_motion(const BlockNumbers& c, const Substep& s, const BlockSystem<Dof>& system) {
  Solved<Dof> out;
  out.change = (system.velocity - system.free_velocity).template head<6>();
  if constexpr (Dof == 12) {  // where straining stops, its angular momentum stays
    const Vec6 strain_rate = system.velocity.template tail<6>();
    out.change.template tail<3>() +=
        c.inverse_inertia.cwiseProduct(system.mass.template block<3, 6>(3, 6) *
                                       (strain_rate - system.free_velocity.template tail<6>()));
    out.strained = s.straining + strain_tensor(strain_rate);
  }
  const Vec3 dv = s.R * out.change.template head<3>();
  out.turn = turn_by_change(c, s.spin_free, out.change.template tail<3>(), s.h / 2);
  out.end = s.free;
  out.end.velocity += dv;
  out.end.pose.position += s.h / 2 * dv;
  out.end.pose.attitude = (rotation_by(s.R * out.turn) * s.free.pose.attitude).normalized();
  out.end.angular_momentum += s.R * out.change.template tail<3>().cwiseProduct(c.inertia).eval();
  return out;
}

/// The law asks how fast the points of the contacts move at the end of the substep. It does so at
/// the attitude without contact; by the turn that contact adds, a body that spins moves otherwise.
/// Sets that into the rows' drift, for a solution that ends with `solved`, and returns by how much
/// it changed there [m/s]. Of the second order in h but for the forces of a hit or a jam. No turn
/// is followed that would change the spin by half of its size or more.
inline double follow_turn(const BlockNumbers& c, const Substep& s, const Solved<6>& solved,
                          std::span<const Contact> contacts, std::span<ContactRow> rows) {
  const Vec3 change = solved.change.tail<3>(), spin = s.spin_free + change;
  const Vec3 by_axes =
      c.inverse_inertia.cwiseProduct(solved.turn.cross(c.inertia.cwiseProduct(spin)));
  // A needle's spin about its axis is all but free: a small turn would seem to set it spinning.
  constexpr double most_followed = 0.5;
  if (by_axes.norm() > most_followed * spin.norm())
    return follow_turn(c, s, Solved<6>{}, contacts, rows);
  double largest = 0;
  for (ContactRow& row : rows) {
    const Vec3& X = contacts[static_cast<std::size_t>(row.contact)].point_a;
    const Vec3 drift = spin.cross(X - row.arm) - by_axes.cross(X) +
                       solved.turn.cross(spin.cross(X)) + row.tilt_speed * row.normal;
    if (row.state != ContactState::open && !row.waits)
      largest = std::max(largest, (drift - row.drift).squaredNorm());
    row.drift = drift;
  }
  return std::sqrt(largest);
}

/// Keeps in `state` the memory of each contact of `work` for the next step, and books its work.
template <int Dof>
void remember(const BlockNumbers& c, const Substep& s, const Solved<Dof>& solved, State& state,
              Work& work, int b, StepReport& report) {
  const double relax = offset_relaxed(c.gravity, s.h), per_h = 1 / s.h;
  std::vector<ContactMemory>& memory = state.memory[b];
  report.n_flips += count_flips(work.rows, memory);
  memory.clear();
  for (ContactRow& row : work.rows) {
    const Contact& contact = work.contacts[row.contact];
    const Vec3 moved = row.free_move + solved.moved(row.arm, s.h);
    const double overlap = -(row.gap_start + row.normal.dot(moved));
    if (row.waits) continue;
    const bool is_open = row.state == ContactState::open;
    if (!is_open || row.offset > 0) note_overlap(b, overlap, c.thickness, work.deep, report);
    if (is_open && row.bond_area == 0) continue;
    const double p_n = row.normal.dot(row.impulse);
    const Vec3 p_t = row.impulse - p_n * row.normal;
    const double along = row.normal.dot(moved);
    state.ledger.contact -= p_n * along * per_h;
    state.ledger.friction -= p_t.dot(moved) * per_h;
    const double offset = std::max(0.0, row.offset - relax);
    // One that begins to stick within the substep has not been wound up by its slip before; it
    // keeps its load, like one that slips.
    const bool winds_up = row.state == ContactState::stick && row.stuck;
    const Vec3 shear = winds_up ? Vec3(row.shear + moved - along * row.normal)
                                : Vec3((-c.recovery_time / row.shear_damping) * p_t);
    memory.push_back(
        {.key = row.key,
         .normal = contact.normal,
         .shear = s.R * shear,
         .offset = offset,
         .gap_end = row.gap_start + row.offset + along - (row.offset - offset),
         .normal_force = p_n * per_h,
         .stiffness = row.bond_area > 0 ? 0 : row.normal_damping * per_h / c.recovery_time,
         .bond_area = row.bond_area,
         .state = static_cast<std::uint8_t>(row.state)});
    if (is_open) continue;  // a bond without tensile strength, hardly open
    ++report.n_closed;
    report.sum_penetration += std::max(overlap, 0.0);
  }
}

}  // namespace talus
