// libcore/dda/contact_law.hpp
// Impulse of one contact as a function of the velocity of its point, and its derivative.
// paper: Eq. (16)-(24) and the three patterns of Fig. 8; theory 1.7 (return mapping), 1.8
//
// Law talus works with impulses over a step. Normal: p_n = max(0, -D_n (v_n + b)), where b holds
// the overlap at the start of the step, so that a resting contact of stiffness k_n presses with k_n
// times its overlap, and one that just closes takes the approach away and no more; where the other
// side gives way at a force (a panel of a fence), p_n stays at that limit. Tangent: the
// trial -D_t (v_t + s / tau) is the impulse while it stays below tan(phi) p_n + c A_c h, else the
// contact slips with tan(phi) p_n along the mean of the slip directions at the step's start and
// end: second order in the step, which the end direction alone is not (it errs by 1e-3 on an
// oblique slide). Inline: this is the innermost loop of the engine.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "dda/contact_row.hpp"

namespace talus {

/// Mean of the slip directions at the start and the end of the step, not yet of unit length. At the
/// speed where slip begins it is the end's alone, so that the impulse is continuous.
[[nodiscard]] inline Vec3 slip_sum(const ContactRow& row, const Vec3& end, double share) {
  const double along = row.slip_start.dot(end);
  return along > 0 ? Vec3(end + (share * along) * row.slip_start) : end;
}

/// Evaluates the law for the point's velocity `w` and keeps what it found in `row`. Body axes
/// throughout.
inline void evaluate(const Vec3& w, ContactRow& row) {
  const Vec3& n = row.normal;
  const double speed_n = n.dot(w);
  const double pressed = -row.normal_damping * (speed_n + row.bias);
  const double p_n = std::min(pressed, row.normal_limit);
  row.gives_way = pressed >= row.normal_limit;
  if (p_n <= -row.tension_impulse) {
    row.state = ContactState::open;
    row.impulse.setZero();
    return;
  }
  row.cap = row.friction * std::max(p_n, 0.0) + row.cohesion_impulse;
  row.trial = w - speed_n * n + row.shear_velocity;
  row.trial_speed = row.trial.norm();
  const double trial_impulse = row.shear_damping * row.trial_speed;
  if (trial_impulse <= row.cap) {
    row.state = ContactState::stick;
    row.impulse = p_n * n - row.shear_damping * row.trial;
    return;
  }
  row.state = ContactState::slip;
  const Vec3 sum = slip_sum(row, (1 / row.trial_speed) * row.trial, 1 - row.cap / trial_impulse);
  row.direction = (1 / sum.norm()) * sum;
  row.impulse = p_n * n - row.cap * row.direction;
}

/// -d impulse / d velocity [kg] where the law was evaluated; not for an open contact. Unsymmetric
/// where it slips, since the bound follows the normal impulse; left out is how the mean direction
/// turns with the bound.
[[nodiscard]] inline Mat3 tangent(const ContactRow& row) {
  const Vec3& n = row.normal;
  const double normal_damping = row.gives_way ? 0 : row.normal_damping;
  Mat3 A;
  if (row.state == ContactState::stick) {
    A = (normal_damping - row.shear_damping) * n * n.transpose();
    A.diagonal().array() += row.shear_damping;
    return A;
  }
  // the end direction turns with the trial only sideways: its derivative is side side^T / speed
  A = Vec3(normal_damping * (n - row.friction * row.direction)) * n.transpose();
  if (row.cap <= 0) return A;
  const Vec3 end = (1 / row.trial_speed) * row.trial, side = n.cross(end);
  const double along = row.slip_start.dot(end);
  if (along <= 0) {
    A += (row.cap / row.trial_speed) * side * side.transpose();
    return A;
  }
  const Vec3 &d = row.direction, &start = row.slip_start;
  const double threshold = row.cap / row.shear_damping, share = 1 - threshold / row.trial_speed;
  if (along > 1 - 1e-12) {  // straight on: what follows, with d = start = end
    A += (row.cap / ((1 + share) * row.trial_speed)) * side * side.transpose();
    return A;
  }
  const double scale = row.cap / slip_sum(row, end, share).norm();
  const double side_scale = scale / row.trial_speed;
  const Vec3 start_change =
      (scale * along * threshold / (row.trial_speed * row.trial_speed)) * end +
      (side_scale * share * side.dot(start)) * side;
  A += (side_scale * (side - d.dot(side) * d)) * side.transpose();
  A += (start - d.dot(start) * d) * start_change.transpose();
  return A;
}

}  // namespace talus
