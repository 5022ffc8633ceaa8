// Impact of one block on the ground: rounds of hits until nothing approaches.
#include "step/impact.hpp"

#include <algorithm>
#include <array>

#include "contact/scales.hpp"
#include "contact/search.hpp"
#include "solver/law_numbers.hpp"
#include "step/soil.hpp"

namespace talus {
namespace {

using std::size_t;

// The block in its own axes.
ImpactBody body_of(const Scene& scene, size_t i, const Motion& motion, const Mat3& R) {
  const Vec3& inertia = scene.blocks.inertia[i];
  ImpactBody body;
  body.inverse_mass = 1 / scene.blocks.mass[i];
  body.inertia = inertia.asDiagonal();
  body.inverse_inertia = inertia.cwiseInverse().asDiagonal();
  body.velocity << R.transpose() * motion.velocity,
      (R.transpose() * motion.angular_momentum).cwiseQuotient(inertia);
  return body;
}

ImpactContact contact_of(const Scene& scene, int b, const Contact& found, const Mat3& R,
                         const ImpactBody& body, const Slide& slide, double resting_speed) {
  const GroundClass& ground = scene.ground.classes[found.ground_class];
  ImpactContact contact;
  contact.normal = R.transpose() * found.normal;
  contact.point = found.point_a;
  contact.friction = ground.friction;
  const Vec3 u = body.velocity.head<3>() + body.velocity.tail<3>().cross(contact.point);
  vary_friction(ground, slide, (u - contact.normal.dot(u) * contact.normal).norm(), 0,
                contact.friction);
  contact.restitution = ground.restitution;
  contact.fall = fall_on(ground, scene.blocks.mass[static_cast<size_t>(b)]);
  contact.arm = arm_on(scene, ground, b);
  contact.dent = dent_on(scene, ground, b);
  contact.resting_speed = resting_speed;
  return contact;
}

double approach_of(const ImpactBody& body, const ImpactContact& contact) {
  return contact.normal.dot(body.velocity.head<3>() + body.velocity.tail<3>().cross(contact.point));
}

// One round of hits on approaching contacts. False when none is faster than the located speed.
bool hit_once(std::span<const ImpactContact> touching, const HitSpeeds& speeds, bool is_last,
              ImpactBody& body, ImpactScratch& scratch, ImpactResult& result) {
  double fastest = 0;
  for (const ImpactContact& contact : touching)
    fastest = std::max(fastest, -approach_of(body, contact));
  if (fastest <= speeds.located) return false;
  result.is_fast |= fastest > speeds.resting;
  scratch.hit.clear();
  for (const ImpactContact& contact : touching)
    if (is_last || approach_of(body, contact) <= rounding * fastest) scratch.hit.push_back(contact);
  if (is_last)
    for (ImpactContact& contact : scratch.hit) contact.restitution = 0;
  const Impact impact = solve_impact({&body, 1}, scratch.hit, scratch.solver);
  result.hit = true;
  result.converged = result.converged && impact.converged;
  result.passes += impact.passes;
  result.dissipated += impact.dissipated;
  result.by_rolling += impact.by_rolling;
  return true;
}

}  // namespace

void reserve_impacts(size_t n_contacts, ImpactScratch& scratch) {
  ImpactWork& w = scratch.solver;
  scratch.touching.reserve(n_contacts);
  scratch.hit.reserve(n_contacts);
  w.full.setZero(6);
  ImpactBody body;  // an impact makes the rest
  body.inverse_mass = 1;
  body.velocity[2] = -1;
  std::array<ImpactContact, FewContacts::most + 1> contacts;  // fewer need less
  for (ImpactContact& contact : contacts) contact.normal = Vec3::UnitZ();
  (void)solve_impact({&body, 1}, contacts, w);
}

ImpactResult apply_impact(const Scene& scene, int b, double touch, const HitSpeeds& speeds,
                          Motion& motion, Work& work) {
  (void)find_contacts(scene.ground, scene.blocks.shapes, b, motion.pose, Mat3::Identity(), touch,
                      work.world_vertices, work.contacts);
  return apply_impact(scene, b, speeds, motion, work);
}

ImpactResult apply_impact(const Scene& scene, int b, const HitSpeeds& speeds, Motion& motion,
                          Work& work) {
  const auto i = static_cast<size_t>(b);
  ImpactResult result;
  const Mat3 R = motion.pose.attitude.toRotationMatrix();
  ImpactBody body = body_of(scene, i, motion, R);
  ImpactScratch& scratch = work.impact;
  scratch.touching.clear();
  for (const Contact& found : work.contacts)
    scratch.touching.push_back(
        contact_of(scene, b, found, R, body, work.soil.slide, speeds.resting));
  for (int round = 1; round <= law::most_hits; ++round)
    if (!hit_once(scratch.touching, speeds, round == law::most_hits, body, scratch, result)) break;
  if (!result.hit) return result;
  motion.velocity = R * body.velocity.head<3>();
  motion.angular_momentum =
      R * body.velocity.tail<3>().cwiseProduct(scene.blocks.inertia[i]).eval();
  return result;
}

}  // namespace talus
