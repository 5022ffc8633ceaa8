#include "step/impact.hpp"

#include <algorithm>
#include <cmath>

#include "contact/search.hpp"
#include "motion/rotation.hpp"
#include "solver/contact_law.hpp"
#include "solver/law_numbers.hpp"
#include "solver/newton.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

// Contacts are stiff dampers during an impact: the velocity condition holds to this part of it.
constexpr double stiffness_ratio = law::impact_stiffness;
constexpr double gain_rounding = law::impact_gain_rounding;

// Less the speed that a contact gives back.
double restitution_bias(const ContactRow& row, double resting_speed) {
  return -returned_speed(row.restitution, row.speed_start, resting_speed);
}

void make_impact_rows(const Scene& scene, int b, double resting_speed, const Mat3& to_body,
                      const Vec6& velocity, Work& work) {
  const double per_mass = 1 / scene.blocks.mass[b];
  const Vec3 per_inertia = scene.blocks.inertia[b].cwiseInverse();
  work.rows.resize(work.contacts.size());
  for (std::size_t i = 0; i < work.contacts.size(); ++i) {
    ContactRow& row = begin_row(scene, b, i, to_body, work.contacts, work.rows);
    row.drift.setZero();
    row.shear_velocity.setZero();
    row.waits = false;
    row.arm = work.contacts[i].point_a;
    set_start(point_velocity<6>(velocity, row.arm), row);
    row.bias = restitution_bias(row, resting_speed);
    const Mobility W = mobility(per_mass, per_inertia, row.arm, row.normal);
    row.normal_damping = stiffness_ratio / W.normal;
    row.shear_damping = stiffness_ratio / W.tangent;
  }
}

double kinetic_energy(const BlockSystem<6>& system, const Vec6& velocity) {
  return 0.5 * velocity.dot(system.mass.diagonal().cwiseProduct(velocity));
}

// The part of the change of velocity that leaves the kinetic energy where it was.
Vec6 limited(const BlockSystem<6>& system, const Vec6& before) {
  const Vec6 change = system.velocity - before;
  const double slope = before.dot(system.mass.diagonal().cwiseProduct(change)),
               curve = 2 * kinetic_energy(system, change);
  return before + std::clamp(-2 * slope / curve, 0.0, 1.0) * change;
}

// What the contacts' stiffness leaves to be done: the change of velocity is too small by the part
// of it that is missing where least is, so that no contact rebounds faster than it should.
double missing_part(const Vec6& after, std::span<const ContactRow> rows, double resting_speed) {
  constexpr double most = 100 / stiffness_ratio;  // beyond, contacts work against each other
  double missing = most;
  for (const ContactRow& row : rows) {
    if (row.state == ContactState::open || row.speed_start >= -resting_speed) continue;
    const double speed = row.normal.dot(point_velocity<6>(after, row.arm));
    missing = std::min(missing, (-row.bias - speed) / (speed - row.speed_start));
  }
  return missing < most ? std::max(0.0, missing) : 0;
}

// Solves again with what each contact gave under its impulse taken out of its speed, so that all
// that press or stick have theirs to rounding. Contacts that press unequally give unequally: a face
// that lands flat would turn by it and come down next on a corner.
void take_out_give(std::span<ContactRow> rows, BlockSystem<6>& system, ImpactResult& result) {
  for (ContactRow& row : rows) {
    row.give = 0;
    if (row.state == ContactState::open) continue;
    const double p_n = row.normal.dot(row.impulse);
    row.give = p_n / row.normal_damping;
    row.bias -= row.give;
    if (row.state == ContactState::stick)
      row.shear_velocity = (1 / row.shear_damping) * (p_n * row.normal - row.impulse);
  }
  const Vec6 found = system.velocity;
  const NewtonResult newton = solve_contacts(system, rows, 120);
  result.passes += newton.passes;
  if (!newton.converged) system.velocity = found;
  for (ContactRow& row : rows) {
    row.bias += row.give;
    row.shear_velocity.setZero();
  }
}

void solve_rows(const Vec6& before, std::span<ContactRow> rows, BlockSystem<6>& system,
                ImpactResult& result) {
  system.velocity = before;
  const NewtonResult newton = solve_contacts(system, rows, 120);
  result.converged = newton.converged;
  result.passes += newton.passes;
  const auto presses = [](const ContactRow& row) { return row.state != ContactState::open; };
  if (newton.converged && std::count_if(rows.begin(), rows.end(), presses) > 1)
    take_out_give(rows, system, result);
}

// Newton's law with friction can gain energy. Without restitution it cannot; between both solutions
// the energy is quadratic in the share of the restitution, so that the largest share that gains
// none is known (theory 1.12). A blend of both keeps momentum and friction cones, and no contact
// approaches.
void lower_restitution(const Vec6& before, double resting_speed, Work& work, BlockSystem<6>& system,
                       ImpactResult& result) {
  const Vec6 full = system.velocity;
  for (ContactRow& row : work.rows) row.bias = 0;
  solve_rows(before, work.rows, system, result);
  const Vec6 stopped = system.velocity, gained = full - stopped;
  const Vec6 momentum = system.mass.diagonal().cwiseProduct(gained);
  const double share =
      largest_share(gained.dot(momentum) / 2, stopped.dot(momentum),
                    kinetic_energy(system, stopped) - kinetic_energy(system, before));
  system.velocity = stopped + share * gained;
  for (ContactRow& row : work.rows) row.bias = share * restitution_bias(row, resting_speed);
}

}  // namespace

double largest_share(double square, double linear, double constant) {
  const double discriminant = linear * linear - 4 * square * constant;
  return std::clamp((-linear + std::sqrt(std::max(0.0, discriminant))) / (2 * square), 0.0, 1.0);
}

ImpactResult apply_impact(const Scene& scene, int b, double touch, const HitSpeeds& speeds,
                          Motion& motion, Work& work) {
  (void)find_contacts(scene.ground, scene.blocks.shapes, b, motion.pose, Mat3::Identity(), touch,
                      work.world_vertices, work.contacts);
  return apply_impact(scene, b, speeds, motion, work);
}

ImpactResult apply_impact(const Scene& scene, int b, const HitSpeeds& speeds, Motion& motion,
                          Work& work) {
  const auto i = static_cast<std::size_t>(b);
  ImpactResult result;
  const Mat3 R = motion.pose.attitude.toRotationMatrix();
  const Vec3& inertia = scene.blocks.inertia[i];
  Vec6 before;
  before << R.transpose() * motion.velocity,
      (R.transpose() * motion.angular_momentum).cwiseQuotient(inertia);
  make_impact_rows(scene, b, speeds.resting, R.transpose(), before, work);
  for (const ContactRow& row : work.rows) {
    result.hit |= row.speed_start < -speeds.located;
    result.is_fast |= row.speed_start < -speeds.resting;
  }
  if (!result.hit) return result;

  BlockSystem<6> system;
  system.mass.setZero();
  system.mass.diagonal() << Vec3::Constant(scene.blocks.mass[i]), inertia;
  system.free_velocity = before;
  system.tolerance =
      1e-8 * (before.head<3>().norm() + before.tail<3>().norm() * scene.blocks.shapes.radius[i]);
  const double energy = kinetic_energy(system, before);
  solve_rows(before, work.rows, system, result);
  if (kinetic_energy(system, system.velocity) > (1 + gain_rounding) * energy)
    lower_restitution(before, speeds.resting, work, system, result);
  const double missing = missing_part(system.velocity, work.rows, speeds.resting);
  system.velocity += missing * (system.velocity - before);
  if (kinetic_energy(system, system.velocity) > energy) system.velocity = limited(system, before);
  result.dissipated = energy - kinetic_energy(system, system.velocity);
  motion.velocity = R * system.velocity.head<3>();
  motion.angular_momentum = R * system.velocity.tail<3>().cwiseProduct(inertia).eval();
  return result;
}

}  // namespace talus
