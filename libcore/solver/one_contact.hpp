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

/// Evaluates the law for the point's velocity and keeps the result in `row`. Body axes
/// throughout.
[[gnu::always_inline]] inline void evaluate(const Vec3& velocity, ContactRow& row) {
  const double w[3] = {velocity.x(), velocity.y(), velocity.z()};
  Found<double> found{};
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
  if (along > 1 - 1e-12) {  // straight on: the formula below, with d = start = end
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
///
/// A couple that stops a spin jumps to the other side of its bound where a step of Newton has gone
/// past the stop, and back. So where the couple that the last step reckoned with, less the couple
/// that would stop the spin now, is within the bound, the part aims at holding.
inline void evaluate_part(const Vec3& spin, const AngularRow& row, double cap, CouplePart& part) {
  const Vec3 reckoned = part.aims ? Vec3(-row.damping * spin) : part.couple;
  const double speed = spin.norm();
  part.spin = spin;
  part.aims = false;
  if (row.damping * speed <= cap) {
    part.state = cap > 0 ? ContactState::stick : ContactState::open;
    part.couple = -row.damping * spin;
    return;
  }
  part.direction = spin / speed;
  part.slip_tangent = cap / speed;
  part.couple = -cap * part.direction;
  part.state = cap > 0 ? ContactState::slip : ContactState::open;
  part.aims = cap > 0 && row.inertia > 0 && (reckoned - row.inertia * spin).norm() <= cap;
}

/// Evaluates the row for the relative spin.
inline void evaluate(const Vec3& spin, const CoupleBounds& bounds, AngularRow& row) {
  const double pressed = bounds.normal.norm();
  row.normal = pressed > 0 ? Vec3(bounds.normal / pressed) : Vec3(Vec3::Zero());
  const Vec3 along = row.normal.dot(spin) * row.normal;
  evaluate_part(spin - along, row, bounds.rolling, row.rolling);
  evaluate_part(along, row, bounds.spinning, row.spinning);
  row.couple = row.rolling.couple + row.spinning.couple;
}

/// The part that a step of Newton has to take off the residual where a couple aims at holding.
[[nodiscard]] inline Vec3 aimed(const AngularRow& row) {
  Vec3 sum = Vec3::Zero();
  for (const CouplePart* part : {&row.rolling, &row.spinning})
    if (part->aims) sum += part->couple + row.damping * part->spin;
  return sum;
}

/// -d couple / d spin [kg m2] where it was evaluated, at constant bounds and mean normal.
[[nodiscard]] inline Mat3 tangent(const AngularRow& row) {
  const Mat3 along = row.normal * row.normal.transpose();
  Mat3 A = Mat3::Zero();
  if (row.rolling.state == ContactState::stick || row.rolling.aims)
    A = row.damping * (Mat3::Identity() - along);
  else if (row.rolling.state == ContactState::slip)
    A = row.rolling.slip_tangent *
        (Mat3::Identity() - along - row.rolling.direction * row.rolling.direction.transpose());
  if (row.spinning.state == ContactState::stick || row.spinning.aims) A += row.damping * along;
  return A;
}

/// -d couple / d (normal impulse) of a contact with arms `arm`: a slipping part follows its bound.
[[nodiscard]] inline Vec3 by_bound(const AngularRow& row, const RowArm& arm) {
  Vec3 change = Vec3::Zero();
  const auto slips = [](const CouplePart& part) {
    return part.state == ContactState::slip && !part.aims;
  };
  if (slips(row.rolling)) change += arm.rolling * row.rolling.direction;
  if (slips(row.spinning)) change += arm.spinning * row.spinning.direction;
  return change;
}

}  // namespace
}  // namespace talus
