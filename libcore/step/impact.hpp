// libcore/step/impact.hpp
// Impact of one block on the ground: all approaching contacts are hit together, then those that the
// hit drives into the ground, until nothing approaches. Replaces Eq. (28).
// theory 1.12 (solver/impact_solve.hpp)
#pragma once

#include <span>

#include "scene/scene.hpp"
#include "scene/state.hpp"
#include "solver/impact_solve.hpp"
#include "step/work.hpp"

namespace talus {

/// Approaches that matter [m/s].
struct HitSpeeds {
  double resting = 0;  ///< slower ones do not rebound
  double located = 0;  ///< slower ones are not hits
};

struct ImpactResult {
  bool hit = false;      ///< some contact approached faster than the located speed
  bool is_fast = false;  ///< one of them than the resting speed
  bool converged = true;
  int passes = 0;
  double dissipated = 0;  ///< kinetic energy lost, >= 0 [J]
  double by_rolling = 0;  ///< ... of it by resistance to rolling [J]
};

/// Applies the impact law to `motion` of block b at its pose; contacts closer than `touch` take
/// part, and those of the located speed or less alone make no impact. Those that approach slower
/// than the resting speed get no restitution.
ImpactResult apply_impact(const Scene& scene, int b, double touch, const HitSpeeds& speeds,
                          Motion& motion, Work& work);

/// The same for the contacts in `work.contacts`.
ImpactResult apply_impact(const Scene& scene, int b, const HitSpeeds& speeds, Motion& motion,
                          Work& work);

/// Room for impacts of one block with up to so many contacts: they allocate nothing then.
void reserve_impacts(std::size_t n_contacts, ImpactScratch& scratch);

}  // namespace talus
