// libcore/solver/one_contact.hpp
// The contact law of one contact, for a lone block and an impact, and its derivative; and of the
// angular row of a pair. Inline: this is the innermost loop of blocks alone.
// theory 1.7 (return mapping), 1.8
#pragma once

#include <Eigen/Geometry>

#include "solver/angular_row.hpp"
#include "solver/contact_law.hpp"

namespace talus {
namespace {

/// A contact as the law reads it.
struct OneContact {
  using Row = LawRow<double>;
  const Row& row;

  [[gnu::always_inline]] void read(double Row::*field, double& out) const { out = row.*field; }
  [[gnu::always_inline]] void read(Vec3 Row::*field, double (&out)[3]) const {
    for (int k = 0; k < 3; ++k) out[k] = (row.*field)[k];
  }
};

/// Evaluates the law for the point's velocity and keeps what it found in `row`. Body axes
/// throughout.
[[gnu::always_inline]] inline void evaluate(const Vec3& velocity, ContactRow& row) {
  const double w[3] = {velocity.x(), velocity.y(), velocity.z()};
  Found<double> found;
  contact_law(OneContact{row}, w, row.state, Evaluation::coupled, found);
  row.state = found.state;
  for (int k = 0; k < 3; ++k) row.impulse[k] = found.impulse[k];
  if (found.state == ContactState::open) return;
  row.normal_tangent = found.normal_tangent;
  row.cap = found.cap;
  if (!found.rubs) return;
  row.trial_speed = found.trial_speed;
  for (int k = 0; k < 3; ++k) row.trial[k] = found.trial[k];
  for (int k = 0; k < 3; ++k) row.direction[k] = found.direction[k];
}

/// -d impulse / d velocity [kg] where the law was evaluated; not for an open contact. Unsymmetric
/// where it slips, since the bound follows the normal impulse; left out is how the mean direction
/// turns with the bound.
[[nodiscard]] inline Mat3 tangent(const ContactRow& row) {
  const Vec3& n = row.normal;
  Mat3 A;
  if (row.state == ContactState::stick) {
    A = (row.normal_tangent - row.shear_damping) * n * n.transpose();
    A.diagonal().array() += row.shear_damping;
    return A;
  }
  if (row.cap <= 0) return row.normal_tangent * n * n.transpose();
  // the end direction turns with the trial only sideways: its derivative is side side^T / speed
  A = Vec3(row.normal_tangent * (n - row.friction * row.direction)) * n.transpose();
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
  const double scale = row.cap / (end + (share * along) * start).norm();
  const double side_scale = scale / row.trial_speed;
  const Vec3 start_change =
      (scale * along * threshold / (row.trial_speed * row.trial_speed)) * end +
      (side_scale * share * side.dot(start)) * side;
  A += (side_scale * (side - d.dot(side) * d)) * side.transpose();
  A += (start - d.dot(start) * d) * start_change.transpose();
  return A;
}

// --- couples -----------------------------------------------------------------------------------

/// A part of a couple: -damping times `spin`, or where that is more than `cap`, of that size.
[[nodiscard]] inline Vec3 couple_part(const Vec3& spin, double damping, double cap,
                                      CouplePart& part) {
  const double speed = spin.norm();
  if (damping * speed <= cap) {
    part.state = cap > 0 ? ContactState::stick : ContactState::open;
    return -damping * spin;
  }
  part.direction = spin / speed;
  part.slip_tangent = cap / speed;
  part.state = cap > 0 ? ContactState::slip : ContactState::open;
  return -cap * part.direction;
}

/// Evaluates the row for the relative spin.
inline void evaluate(const Vec3& spin, const CoupleBounds& bounds, AngularRow& row) {
  const double pressed = bounds.normal.norm();
  row.normal = pressed > 0 ? Vec3(bounds.normal / pressed) : Vec3(Vec3::Zero());
  const Vec3 along = row.normal.dot(spin) * row.normal;
  row.couple = couple_part(spin - along, row.damping, bounds.rolling, row.rolling);
  row.couple += couple_part(along, row.damping, bounds.spinning, row.spinning);
}

/// -d couple / d spin [kg m2] where it was evaluated, at constant bounds and mean normal.
[[nodiscard]] inline Mat3 tangent(const AngularRow& row) {
  const Mat3 along = row.normal * row.normal.transpose();
  Mat3 A = Mat3::Zero();
  if (row.rolling.state == ContactState::stick)
    A = row.damping * (Mat3::Identity() - along);
  else if (row.rolling.state == ContactState::slip)
    A = row.rolling.slip_tangent *
        (Mat3::Identity() - along - row.rolling.direction * row.rolling.direction.transpose());
  if (row.spinning.state == ContactState::stick) A += row.damping * along;
  return A;
}

/// -d couple / d (normal impulse) of a contact with arms `arm`: what slips follows its bound.
[[nodiscard]] inline Vec3 by_bound(const AngularRow& row, const RowArm& arm) {
  Vec3 change = Vec3::Zero();
  if (row.rolling.state == ContactState::slip) change += arm.rolling * row.rolling.direction;
  if (row.spinning.state == ContactState::slip) change += arm.spinning * row.spinning.direction;
  return change;
}

}  // namespace
}  // namespace talus
