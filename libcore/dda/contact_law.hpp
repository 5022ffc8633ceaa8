// libcore/dda/contact_law.hpp
// Impulse of one contact as a function of the velocity of its point, and its exact derivative.
// paper: Eq. (16)-(24) and the three patterns of Fig. 8; theory 1.7 (return mapping), 1.8
//
// Law talus works with impulses over a step. Normal: p_n = max(0, -D_n (v_n + b)), where b holds the
// overlap at the start of the step, so that a resting contact of stiffness k_n presses with k_n times
// its overlap, and one that just closes takes the approach away and no more. Tangent: the trial
// -D_t (v_t + s / tau) is the impulse while it stays below tan(phi) p_n + c A_c h, else the contact
// slips with tan(phi) p_n along the mean of the slip directions at the step's start and end: second
// order in the step, which the end direction alone is not (it errs by 1e-3 on an oblique slide).
#pragma once

#include "dda/work.hpp"

namespace talus {

/// What the contact law gives at a point velocity.
struct ContactResponse {
  Vec3 impulse;            ///< on A [N s]
  Mat3 tangent;            ///< -d impulse / d velocity [kg]
  ContactState state;
};

/// Body axes throughout. `cap` < 0: the friction bound follows the normal impulse (Newton couples
/// the two, the tangent is not symmetric); otherwise the bound is `cap` [N s].
[[nodiscard]] ContactResponse contact_response(const ContactRow& row, const Vec3& velocity, double cap);

}  // namespace talus
