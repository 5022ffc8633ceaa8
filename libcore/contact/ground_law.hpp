// libcore/contact/ground_law.hpp: public
// The law of the ground: the numbers of a class of ground, and restitution, friction, rolling
// resistance and drag that follow from them. All solvers read it from here.
// theory 1.13; docs/reference/site-file.md
#pragma once

#include <array>

namespace talus {

/// Law of contact with one class of ground.
struct GroundClass {
  double friction = 0;     ///< tan(phi), >= 0 [-]
  double cohesion = 0;     ///< c, acts on bonded area until the bond breaks [Pa]
  double tension = 0;      ///< tensile strength of the same bond [Pa]
  double restitution = 0;  ///< coefficient of restitution along the normal, 0 to 1 [-]
  // yielding ground; each as it is here: nothing
  double half_speed = 0;     ///< v_h: approach that halves the restitution [m/s]
  double half_energy = 0;    ///< E_05: or the energy of it [J]
  double rolling = 0;        ///< mu_r: couple against rolling per normal force and radius [-]
  double spinning = -1;      ///< mu_s: against pivoting about the normal; < 0: as rolling [-]
  double bearing = 0;        ///< q: mu_r by the dent of weight or hit instead [Pa]
  double scar_friction = 0;  ///< mu_max: tan(phi) that slip leads to [-]
  double scar_rate = 0;      ///< kappa: rate per slid distance [1/m]
  double scar_decay = 0;     ///< beta: rate at which the slid distance decays off the ground [1/s]
  double weak_friction = 0;  ///< mu_w: tan(phi) at high speed of slip [-]
  double weakening_speed = 0;    ///< U_w: slip speed at which half of the drop is reached [m/s]
  double drag_per_time = 0;      ///< nu [1/s]
  double drag_per_distance = 0;  ///< c [1/m]
  // a rough joint, see rough_friction()
  double roughness = 0;      ///< JRC, the angle per decade of JCS over stress; 0: smooth [rad]
  double wall_strength = 0;  ///< JCS [Pa]
  double residual = 0;       ///< phi_r, whose tangent `friction` is [rad]
};

/// The numbers of yielding ground: at least 0, or as in firm ground.
inline constexpr std::array yielding_numbers = {
    &GroundClass::half_speed,      &GroundClass::half_energy,   &GroundClass::rolling,
    &GroundClass::spinning,        &GroundClass::bearing,       &GroundClass::scar_friction,
    &GroundClass::scar_rate,       &GroundClass::scar_decay,    &GroundClass::weak_friction,
    &GroundClass::weakening_speed, &GroundClass::drag_per_time, &GroundClass::drag_per_distance};

/// Whether any of them is not as in firm ground.
[[nodiscard]] bool yields(const GroundClass& ground);
/// ... and whether the ground resists rolling or pivoting; has friction that follows the slid
/// distance; the speed; either of them; has drag; has a restitution that falls.
[[nodiscard]] inline bool resists_rolling(const GroundClass& ground) {
  return ground.rolling > 0 || ground.bearing > 0 || ground.spinning > 0;
}
[[nodiscard]] inline bool scars(const GroundClass& ground) { return ground.scar_rate > 0; }
[[nodiscard]] inline bool weakens(const GroundClass& ground) { return ground.weakening_speed > 0; }
[[nodiscard]] inline bool varies_friction(const GroundClass& ground) {
  return scars(ground) || weakens(ground);
}
[[nodiscard]] inline bool is_rough(const GroundClass& ground) { return ground.roughness > 0; }
[[nodiscard]] inline bool drags(const GroundClass& ground) {
  return ground.drag_per_time > 0 || ground.drag_per_distance > 0;
}
[[nodiscard]] inline bool restitution_falls(const GroundClass& ground) {
  return ground.half_speed > 0 || ground.half_energy > 0;
}

/// How a restitution falls with the approach v > 0: to that at no speed over 1 + per_speed v +
/// per_square v^2. All zero: it does not.
struct RestitutionFall {
  double per_speed = 0;   ///< [s/m]
  double per_square = 0;  ///< [s2/m2]

  [[nodiscard]] double at(double restitution, double v) const {
    return restitution / (1 + v * (per_speed + per_square * v));
  }
};

/// How the restitution on `ground` falls for a block of `mass` [kg].
[[nodiscard]] RestitutionFall fall_on(const GroundClass& ground, double mass);

/// tan(phi) of ground at slip `speed` after a slid distance of `slid`; and its mean over a further
/// path, exact in the work of friction that follows the slid distance.
[[nodiscard]] double friction_on(const GroundClass& ground, double speed, double slid);
[[nodiscard]] double mean_friction(const GroundClass& ground, double speed, double slid,
                                   double path);

/// tan(phi) of a rough joint at a normal stress [Pa] by Barton and Bandis:
///
///     tan(phi_r + JRC log10(JCS / stress)), from phi_r up to 70 degrees.
///
/// Where strength is reduced, `friction` is less than the tangent of phi_r, and this in proportion.
[[nodiscard]] double rough_friction(const GroundClass& joint, double stress);

/// mu_r for a block whose sphere of equal volume has `radius`, of `weight` per volume [N/m3]: by
/// the ground's bearing strength 4 / (3 pi) sqrt(8 weight radius / (3 q)), at most 0.5.
[[nodiscard]] double rolling_on(const GroundClass& ground, double weight, double radius);

/// The dent that a sphere hits into ground of bearing strength q: its volume times q is the energy
/// of the approach v. Depth d = v sqrt(m / (2 pi R q)), half width sqrt(2 R d), at most R. All
/// zero: none.
struct Dent {
  double square_per_speed = 0;  ///< square of the half width per approach [m s]
  double widest = 0;            ///< [m]

  /// Arm of the couple against rolling: from the middle to the centre of the front half [m].
  [[nodiscard]] double arm_at(double v) const;
};
[[nodiscard]] Dent dent_in(const GroundClass& ground, double mass, double radius);

/// Factor of velocity and spin at `speed` after a time h of drag.
[[nodiscard]] double kept_by_drag(const GroundClass& ground, double speed, double h);

}  // namespace talus
