// libcore/step/impact.hpp
// Impact of one block on the ground: a change of velocity at one instant, for all touching contacts
// together: v_n+ >= -e v_n-, p_n >= 0, complementary; Coulomb friction on the impulses.
// theory 1.12 (Newton's law at velocity level); replaces Eq. (28)
#pragma once

#include <span>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "step/work.hpp"

namespace talus {

/// Approaches that matter [m/s].
struct HitSpeeds {
  double resting = 0;  ///< slower ones do not rebound
  double located = 0;  ///< slower ones are no hits
};

struct ImpactResult {
  bool hit = false;      ///< some contact approached faster than the located speed
  bool is_fast = false;  ///< one of them than the resting speed
  bool converged = true;
  int passes = 0;
  double dissipated = 0;  ///< kinetic energy lost, >= 0 [J]
};

/// Applies the impact law to `motion` of block b at its pose; contacts closer than `touch` take
/// part, and those of `located_speed` or less alone make no impact. Those that approach slower than
/// `resting_speed` get no restitution. Where Newton's law with friction would raise the kinetic
/// energy, the restitution of all contacts is lowered until it does not.
ImpactResult apply_impact(const Scene& scene, int b, double touch, const HitSpeeds& speeds,
                          Motion& motion, Work& work);

/// The same for the contacts that stand in `work.contacts`.
ImpactResult apply_impact(const Scene& scene, int b, const HitSpeeds& speeds, Motion& motion,
                          Work& work);

/// Largest share f <= 1 of a restitution at which square f^2 + linear f + constant, what it gains
/// or lacks of the energy that it must lose, is not above zero; where none is, the share at which
/// it is least. `square` > 0; at f = 1 the sum is above zero.
[[nodiscard]] double largest_share(double square, double linear, double constant);

}  // namespace talus
