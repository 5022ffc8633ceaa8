// libcore/solver/angular_row.hpp
// A couple between two bodies beside the impulses at their points, as of rolling resistance: it
// holds the relative spin by damping (and a spring) up to an arm times the normal impulses of the
// same pair in the same step. The contact law with spin for velocity:
// evaluate() and tangent() in solver/one_contact.hpp.
#pragma once

#include "contact/contact.hpp"

namespace talus {

/// The angular row of a pair, axes as the rows of its points.
struct AngularRow {
  int row_begin = 0, row_end = 0;   ///< a lone block: rows whose normal impulses bound it
  double arm = 0;                   ///< largest couple per normal force [m]
  double damping = 0;               ///< couple impulse per spin while it holds, > 0 [kg m2]
  Vec3 spring_spin = Vec3::Zero();  ///< angle of its spring over tau [1/s]
  // at the last evaluation
  Vec3 couple = Vec3::Zero();  ///< on A; B gets the opposite [N m s]
  ContactState state = ContactState::open;
  double cap = 0;                 ///< bound of the couple [N m s]
  Vec3 direction = Vec3::Zero();  ///< of spin and spring, unit; while it slips
  double slip_tangent = 0;        ///< across `direction`, while it slips [kg m2]
};

}  // namespace talus
