// libcore/solver/angular_row.hpp: public
// A couple between two bodies besides the impulses at their points: resistance to rolling and
// pivoting. It holds the relative spin by damping, the part along the contacts' mean normal and the
// part across each up to an arm times the normal impulses of the same pair in the same step. The
// contact law with spin for velocity: evaluate() and tangent() in solver/one_contact.hpp.
// theory: 1.13
#pragma once

#include <algorithm>

#include "contact/contact.hpp"

namespace talus {

/// Largest couples of a contact per normal force [m].
struct RowArm {
  double rolling = 0;   ///< across the normal
  double spinning = 0;  ///< along it

  [[nodiscard]] RowArm at_least(double arm) const {
    return {std::max(rolling, arm), std::max(spinning, arm)};
  }
};

/// Bounds of a couple from normal impulses.
struct CoupleBounds {
  double rolling = 0, spinning = 0;  ///< [N m s]
  Vec3 normal = Vec3::Zero();        ///< sum of the normal impulses [N s]

  void add(const RowArm& arm, double p_n, const Vec3& n) {
    if (!(p_n > 0)) return;
    rolling += arm.rolling * p_n;
    spinning += arm.spinning * p_n;
    normal += p_n * n;
  }
};

/// A part of a couple at its last evaluation.
struct CouplePart {
  ContactState state = ContactState::open;
  bool aims = false;              ///< it slips, and is about to hold
  Vec3 spin = Vec3::Zero();       ///< [rad/s]
  Vec3 couple = Vec3::Zero();     ///< [N m s]
  Vec3 direction = Vec3::Zero();  ///< of the spin, unit; while it slips
  double slip_tangent = 0;        ///< across `direction`, while it slips [kg m2]
};

/// The angular row of a pair, axes as the rows of its points.
struct AngularRow {
  int row_begin = 0, row_end = 0;   ///< a lone block: rows whose normal impulses bound it
  int arm_begin = 0;                ///< of the arms of the pair's rows
  double damping = 0;               ///< couple impulse per spin while it holds, > 0 [kg m2]
  double inertia = 0;               ///< that it turns, about; 0: it never aims [kg m2]
  bool is_off = false;              ///< the couple is zero, whatever the rows carry
  Vec3 held_normal = Vec3::Zero();  ///< replaces the mean normal, where not zero
  // at the last evaluation
  Vec3 couple = Vec3::Zero();  ///< on A; B gets the opposite [N m s]
  Vec3 normal = Vec3::Zero();  ///< mean normal, unit; zero: nothing presses
  CouplePart rolling, spinning;
};

}  // namespace talus
