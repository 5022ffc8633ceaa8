// Law of the ground: friction after slip, rolling resistance, dents and restitution.
#include "contact/ground_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus {
namespace {

using std::numbers::pi;

constexpr double most_by_bearing = 0.5;  // mu_r: deeper in, the half disc says nothing

// Centre of half a disc, from its middle.
double half_disc_centre(double radius) { return 4 * radius / (3 * pi); }

// Integral of friction along the slid distance, from 0 to `slid`.
double scar_work(const GroundClass& ground, double slid) {
  const double kappa = ground.scar_rate, x = kappa * slid;
  return ground.friction * slid + 2 / pi * (ground.scar_friction - ground.friction) *
                                      (slid * std::atan(x) - std::log1p(x * x) / (2 * kappa));
}

}  // namespace

bool yields(const GroundClass& ground) {
  return std::any_of(yielding_numbers.begin(), yielding_numbers.end(),
                     [&](auto number) { return ground.*number != GroundClass{}.*number; });
}

RestitutionFall fall_on(const GroundClass& ground, double mass) {
  RestitutionFall fall;
  if (ground.half_speed > 0) fall.per_speed = 1 / ground.half_speed;
  if (ground.half_energy > 0) fall.per_square = mass / (2 * ground.half_energy);
  return fall;
}

double friction_on(const GroundClass& ground, double speed, double slid) {
  if (scars(ground))
    return ground.friction +
           2 / pi * (ground.scar_friction - ground.friction) * std::atan(ground.scar_rate * slid);
  if (weakens(ground))
    return ground.weak_friction +
           (ground.friction - ground.weak_friction) / (1 + speed / ground.weakening_speed);
  return ground.friction;
}

double mean_friction(const GroundClass& ground, double speed, double slid, double path) {
  // below this the quotient is rounding
  if (!scars(ground) || ground.scar_rate * path < 1e-6)
    return friction_on(ground, speed, slid + path / 2);
  return (scar_work(ground, slid + path) - scar_work(ground, slid)) / path;
}

double rough_friction(const GroundClass& joint, double stress) {
  constexpr double steepest = 70 * pi / 180;
  if (!(stress < joint.wall_strength)) return joint.friction;
  const double decades = std::log10(joint.wall_strength / std::max(stress, 1e-300));
  const double angle = std::min(steepest, joint.residual + joint.roughness * decades);
  return joint.friction * std::max(1.0, std::tan(angle) / std::tan(joint.residual));
}

double rolling_on(const GroundClass& ground, double weight, double radius) {
  if (ground.bearing == 0) return ground.rolling;
  return std::min(most_by_bearing,
                  half_disc_centre(std::sqrt(8 * weight * radius / (3 * ground.bearing))));
}

double Dent::arm_at(double v) const {
  return half_disc_centre(std::min(widest, std::sqrt(square_per_speed * v)));
}

Dent dent_in(const GroundClass& ground, double mass, double radius) {
  if (ground.bearing == 0) return {};
  return {2 * radius * std::sqrt(mass / (2 * pi * radius * ground.bearing)), radius};
}

double kept_by_drag(const GroundClass& ground, double speed, double h) {
  return std::exp(-ground.drag_per_time * h) * (1 / (1 + ground.drag_per_distance * speed * h));
}

}  // namespace talus
