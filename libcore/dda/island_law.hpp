// libcore/dda/island_law.hpp
// The contact law for the rows of an island: impulse at a velocity, and a symmetric tangent.
// The impulse is that of dda/contact_law.hpp; a test holds the two together.
//
// The tangent leaves out what makes it unsymmetric: the change of the friction bound with the normal
// impulse. Newton stays a descent direction and conjugate gradients apply; the bound itself is
// renewed at every evaluation.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "dda/island.hpp"

namespace talus {

[[nodiscard]] inline double friction_bound(const IslandRow& row, double p_n) {
  return row.friction * std::max(p_n, 0.0) + row.cohesion_impulse;
}

inline void set_open(IslandRow& row) {
  row.impulse.setZero();
  row.slip_stiffness = 0;
  row.state = ContactState::open;
}

/// Adds friction to the normal impulse p_n of a closed contact. `trial`: tangential velocity plus
/// that of the shear spring. Slip is along the mean of its directions at the step's start and end.
inline void set_closed(IslandRow& row, double p_n, const Vec3& trial, double cap) {
  row.impulse = p_n * row.normal;
  const double speed_sq = trial.squaredNorm();
  const double stick_sq = row.shear_damping * row.shear_damping * speed_sq;
  row.slip_stiffness = 0;
  if (stick_sq <= cap * cap) {
    row.state = ContactState::stick;
    row.impulse -= row.shear_damping * trial;
    return;
  }
  row.state = ContactState::slip;
  if (!(cap > 0)) return;
  const double speed = std::sqrt(speed_sq);
  const Vec3 end = trial / speed;
  const double along = row.slip_start.dot(end);
  if (!(along > 0)) {
    row.impulse -= cap * end;
    row.slip_stiffness = cap / speed;
    return;
  }
  // At an angle t from the start direction the mean is at atan(tan(t) / 2), which turns by
  // 2 / (1 + 3 cos^2 t) as t grows.
  const double length_sq = 1 + 3 * along * along;
  row.impulse -= (cap / std::sqrt(length_sq)) * (end + along * row.slip_start);
  row.slip_stiffness = 2 * cap / (length_sq * speed);
}

/// The law at relative velocity w. `held`: the friction bound is row.held_cap.
inline void apply_law(IslandRow& row, const Vec3& w, bool held) {
  const double v_n = row.normal.dot(w);
  const double p_n = -row.normal_damping * (v_n + row.bias);
  if (p_n <= -row.tension_impulse) return set_open(row);
  set_closed(row, p_n, w - v_n * row.normal + row.shear_velocity,
             held ? row.held_cap : friction_bound(row, p_n));
}

/// For the first iteration: inherited states, friction bounded by the last step's normal impulse (one
/// from the predicted overlap has no bound), a contact that newly closes sticks.
inline void apply_inherited(IslandRow& row, const Vec3& w) {
  const double v_n = row.normal.dot(w);
  const double p_n = -row.normal_damping * (v_n + row.bias);
  if (row.state == ContactState::open && p_n <= -row.tension_impulse) return set_open(row);
  const double last_p_n = row.normal.dot(row.impulse);
  const bool frictionless = row.friction <= 0 && row.cohesion_impulse <= 0;
  const bool holds = row.state != ContactState::slip && !frictionless;
  const double cap =
      holds ? std::numeric_limits<double>::infinity() : friction_bound(row, last_p_n);
  set_closed(row, p_n, w - v_n * row.normal + row.shear_velocity, cap);
}

}  // namespace talus
