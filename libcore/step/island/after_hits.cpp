// Stage 6 of an island's step, its end: hits become part of the motion without contact, about which
// the contacts that press are solved. A body that was pressed before is pressed over all of the
// substep; another from its last hit on.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "solver/law_numbers.hpp"
#include "step/island/impact_search.hpp"

namespace talus {
namespace {

using std::size_t;

using law::after_hit, law::stiffest_at_rest, law::shallow;

// Where member k is at the end of the substep without contact forces.
PlacedMotion free_end(const FreeMotions& free, size_t k) {
  const Motion& end = free.substeps[k].free;
  return {end.pose.position, free.turns[k].by, end.velocity, free.turns[k].spin_end};
}

Mobility relative_mobility(const IslandMembers& members, const FreeMotions& free,
                           const IslandSystem& system, size_t r) {
  const KeptContact& contact = system.contacts[r];
  const BodyPair& pair = system.island.pairs[contact.pair];
  const auto ka = static_cast<size_t>(pair.a);
  const Vec3 normal = row_of(system, r).normal(), arm = row_of(system, r).arm();
  Mobility W = mobility_at(members, free, ka, arm, normal);
  if (pair.b < 0) return W;
  const auto kb = static_cast<size_t>(pair.b);
  const Mobility Wb = mobility_at(members, free, kb, arm + pair.shift, normal);
  W.normal += Wb.normal;
  W.tangent += Wb.tangent;
  return W;
}

// Velocity of the points of contact `r` at the end that its arms do not tell.
Vec3 drift_of(const FreeMotions& free, const IslandSystem& system, size_t r) {
  const KeptContact& contact = system.contacts[r];
  const BodyPair& pair = system.island.pairs[contact.pair];
  const auto ka = static_cast<size_t>(pair.a);
  const PlacedMotion a = free_end(free, ka);
  PlacedMotion b;
  if (pair.b >= 0) b = free_end(free, static_cast<size_t>(pair.b));
  const Vec3 velocity = row_motion(free, system, r, a, pair.b < 0 ? nullptr : &b).velocity;
  return velocity - relative(system, r, [&](size_t k) -> Vec6 {
           Vec6 v;
           v << free.substeps[k].free.velocity, free.turns[k].spin_end;
           return v;
         });
}

void set_drift(const Vec3& drift, double bias, const Vec3& shear_velocity, const IslandRow& row) {
  const Vec3 normal = row.normal();
  const double along = normal.dot(drift);
  row.set_bias(bias + along);
  row.set_shear_velocity(shear_velocity + (drift - along * normal));
}

// Contact `r`, which waits, presses from now on as far as that stops it. `gap`, with which it
// enters the rest of the substep.
void stop(const IslandMembers& members, const FreeMotions& free, size_t r, double gap, double rest,
          IslandSystem& system, SubstepHits& hits) {
  KeptContact& contact = system.contacts[r];
  const IslandRow row = row_of(system, r);
  contact.waits = false;
  note_hit(r, free.h - rest, system, hits);
  const Mobility W = relative_mobility(members, free, system, r);
  row.begin_open(stiffest_at_rest / W.normal, stiffest_at_rest / W.tangent);
  set_drift(drift_of(free, system, r), std::max(0.0, gap) / rest, Vec3::Zero(), row);
  note_change(system, r);
}

// Contact `r` presses nothing: a fast approach is hit, in the next substep where this one did not
// find it.
void wait_for_hit(size_t r, IslandSystem& system) {
  const IslandRow row = row_of(system, r);
  system.contacts[r].waits = true;
  row.begin_open(0, 0);
  row.set_bias(0);
  system.waiting.push_back(r);
}

// Bodies of the island and their free motion, for member k, which was hit.
void take_member(const ImpactSearch& looks, size_t k, FreeMotions& free, IslandSystem& system,
                 SubstepHits& hits) {
  const BlockNumbers& c = looks.members.numbers[k];
  if (c.stands) return;
  const Motion end = looks.motion_of(k, free.h);
  Substep& s = free.substeps[k];
  FreeTurn& turn = free.turns[k];
  const Eigen::AngleAxisd turned(end.pose.attitude * s.free.pose.attitude.conjugate());
  hits.impact_displacement[k] << end.pose.position - s.free.pose.position,
      turned.angle() * turned.axis();
  s.free = end;
  s.R = end.pose.attitude.toRotationMatrix();
  s.spin_free = (s.R.transpose() * end.angular_momentum).cwiseProduct(c.inverse_inertia);
  turn.by = s.R * s.R_start.transpose();
  turn.spin_end = s.R * s.spin_free;
  turn.inverse_inertia = s.R * c.inverse_inertia.asDiagonal() * s.R.transpose();
  Island& island = system.island;
  island.mass[k].bottomRightCorner<3, 3>() = s.R * c.inertia.asDiagonal() * s.R.transpose();
  island.free_velocity[k] << end.velocity, turn.spin_end;
  island.velocity[k] = island.free_velocity[k];
}

bool pressed_before(const IslandSystem& system, size_t p) {
  for (const size_t r : contacts_of(system, p))
    if (system.contacts[r].memory >= 0 && !system.contacts[r].waits) return true;
  return false;
}

// Members that something pressed before. Where their pairs had times of their own, impulses of a
// jam that balance would not: they would displace a block by their size times the difference of
// these times.
void find_pressed(const IslandSystem& system, size_t n_members,
                  std::vector<std::uint8_t>& is_pressed) {
  is_pressed.assign(n_members, 0);
  for (size_t p = 0; p < system.island.pairs.size(); ++p) {
    if (!pressed_before(system, p)) continue;
    const BodyPair& pair = system.island.pairs[p];
    is_pressed[static_cast<size_t>(pair.a)] = 1;
    if (pair.b >= 0) is_pressed[static_cast<size_t>(pair.b)] = 1;
  }
}

/// The part of the substep over which the contacts of a pair press: all of it where something
/// pressed one of its bodies before, else the rest after their last hit.
struct PairRest {
  double length = 0;  // [s]
  bool has_b = false;
  PlacedMotion a, b, end_a, end_b;  // at its begin, and at the end without contact
};

PairRest rest_of(const ImpactSearch& looks, const IslandSystem& system, size_t p,
                 const FreeMotions& free) {
  const BodyPair& pair = system.island.pairs[p];
  const auto ka = static_cast<size_t>(pair.a), kb = static_cast<size_t>(std::max(pair.b, 0));
  PairRest rest;
  rest.has_b = pair.b >= 0;
  double from = looks.hits.members[ka].clock;
  if (rest.has_b) from = std::max(from, looks.hits.members[kb].clock);
  const std::vector<std::uint8_t>& is_pressed = looks.hits.is_pressed;
  if (is_pressed[ka] != 0 || (rest.has_b && is_pressed[kb] != 0)) from = 0;
  rest.length = std::max(free.h - from, after_hit * free.h);
  rest.a = looks.member_at(ka, from).placed;
  rest.end_a = free_end(free, ka);
  if (!rest.has_b) return rest;
  rest.b = looks.member_at(kb, from).placed;
  rest.end_b = free_end(free, kb);
  return rest;
}

// Point where an impulse on a body acts that presses it in the middle of `rest`: there impulse and
// moved momentum have the same moment, so that angular momentum is kept.
Vec3 place_of_impulse(const PlacedMotion& end, double rest) {
  return end.position - rest / 2 * end.velocity;
}

// Row of a pair of which a member was hit.
void take_row(const ImpactSearch& looks, size_t r, const PairRest& of, const FreeMotions& free,
              IslandSystem& system, SubstepHits& hits) {
  KeptContact& contact = system.contacts[r];
  const BodyPair& pair = system.island.pairs[contact.pair];
  const auto ka = static_cast<size_t>(pair.a);
  const double rest = of.length;
  const RowMotion now = row_motion(free, system, r, of.a, of.has_b ? &of.b : nullptr);
  const RowMotion then = row_motion(free, system, r, of.end_a, of.has_b ? &of.end_b : nullptr);
  const IslandRow row = row_of(system, r);
  const Vec3 normal = row.normal();
  contact.free_move = then.point_a - then.point_b - contact.gap_start * normal;
  contact.gap_free = then.gap;
  contact.arm = (now.point_a + then.point_a + now.point_b + then.point_b) / 4 -
                place_of_impulse(of.end_a, rest);
  row.set_arm(contact.arm);
  if (contact.waits) {
    const bool is_over = hits.is_closed[contact.pair] != 0;
    if (then.gap <= contact.touch &&
        (is_over || then.speed >= -looks.members.numbers[ka].resting_speed))
      stop(looks.members, free, r, now.gap, rest, system, hits);
    return;
  }
  const bool is_new =
      contact.memory < 0 && contact.bond_area == 0 && row.normal_limit() >= no_normal_limit;
  if (is_new && then.speed < -looks.members.numbers[ka].resting_speed &&
      hits.is_closed[contact.pair] == 0)
    return wait_for_hit(r, system);
  if (is_new) contact.offset = std::max(contact.offset, -now.gap);
  const double per_recovery = 1 / looks.members.numbers[ka].recovery_time;
  const double x = now.gap + contact.offset;
  const double bias = x < 0 || contact.bond_area != 0 ? x * per_recovery : x / rest;
  set_drift(drift_of(free, system, r), bias, per_recovery * contact.shear, row);
  const Vec3 slip = now.velocity - now.speed * normal;
  const double slip_speed = slip.norm();
  row.set_slip_start(slip_speed > 0 ? Vec3(slip / slip_speed) : Vec3(Vec3::Zero()));
}

// The pair acts in the middle of the time over which it presses.
void take_pair(const ImpactSearch& looks, size_t p, const FreeMotions& free, IslandSystem& system,
               SubstepHits& hits) {
  BodyPair& pair = system.island.pairs[p];
  const PairRest rest = rest_of(looks, system, p, free);
  hits.pair_time[p] = free.h - rest.length / 2;
  if (rest.has_b)
    pair.shift =
        place_of_impulse(rest.end_a, rest.length) - place_of_impulse(rest.end_b, rest.length);
  for (const size_t r : contacts_of(system, p)) take_row(looks, r, rest, free, system, hits);
}

// Change of the velocity of member k of pair `p` by its contacts.
Vec6 change_by_pair(const IslandSystem& system, size_t p, int k) {
  const BodyPair& pair = system.island.pairs[p];
  Vec6 sum = Vec6::Zero();
  for (const size_t r : contacts_of(system, p)) {
    const ConstIslandRow row = row_of(system, r);
    const Vec3 impulse = row.impulse();
    if (impulse.isZero(0)) continue;
    const Vec3 arm = k == pair.a ? row.arm() : Vec3(row.arm() + pair.shift);
    const double sign = k == pair.a ? 1 : -1;
    sum.head<3>() += sign * impulse;
    sum.tail<3>() += sign * arm.cross(impulse);
  }
  if (pair.angular >= 0) {  // a couple acts with the contacts that bound it
    const Vec3& couple = system.island.angular[static_cast<size_t>(pair.angular)].couple;
    sum.tail<3>() += k == pair.a ? couple : Vec3(-couple);
  }
  return solve_mass(system.island.mass[k], sum);
}

}  // namespace

void set_displacements(double h, const IslandSystem& system, const SubstepHits& hits,
                       std::vector<Vec6>& displacement) {
  const Island& island = system.island;
  displacement.resize(island.mass.size());
  for (size_t k = 0; k < displacement.size(); ++k) displacement[k] = h / 2 * change(island, k);
  if (hits.hit_members.items.empty()) return;
  for (size_t p = 0; p < island.pairs.size(); ++p) {
    const double later = hits.pair_time[p] - h / 2;
    if (later == 0) continue;
    for (const int k : {island.pairs[p].a, island.pairs[p].b})
      if (k >= 0) displacement[k] -= later * change_by_pair(system, p, k);
  }
}

void take_hits(const ImpactSearch& looks, FreeMotions& free, IslandSystem& system,
               SubstepHits& hits) {
  const size_t n = looks.members.size();
  hits.pair_time.assign(system.island.pairs.size(), free.h / 2);
  hits.impact_displacement.assign(n, Vec6::Zero());
  for (const int k : hits.hit_members.items)
    take_member(looks, static_cast<size_t>(k), free, system, hits);
  if (!hits.hit_members.items.empty()) find_pressed(system, n, hits.is_pressed);
  const auto was_hit = [&](int k) { return k >= 0 && hits.hit_members.contains(k); };
  if (!hits.hit_members.items.empty())
    for (size_t p = 0; p < system.island.pairs.size(); ++p) {
      if (!was_hit(system.island.pairs[p].a) && !was_hit(system.island.pairs[p].b)) continue;
      take_pair(looks, p, free, system, hits);
    }
  std::erase_if(system.waiting, [&](size_t r) { return !system.contacts[r].waits; });
}

int close_waiting(const IslandMembers& members, const FreeMotions& free, IslandSystem& system,
                  SubstepHits& hits) {
  if (system.waiting.empty()) {
    hits.moved.clear();
    return 0;
  }
  set_displacements(free.h, system, hits, hits.displacement);
  const auto closes = [&](size_t r) {
    const KeptContact& contact = system.contacts[r];
    const auto moved = [&](int b) {
      return b >= 0 && hits.moved.contains(static_cast<int>(members.at(b)));
    };
    if (!moved(contact.a) && !moved(contact.b)) return false;
    const auto p = static_cast<size_t>(contact.pair);
    // where it was looked for, the features that its gap tells of did not meet
    if (hits.n_looks[p] > 0 && hits.is_closed[p] == 0) return false;
    const Vec3 normal = row_of(system, r).normal();
    const double gap_end =
        contact.gap_free + normal.dot(relative(system, r, [&](size_t k) -> const Vec6& {
          return hits.displacement[k];
        }));
    if (gap_end > contact.touch) return false;
    const double speed =
        normal.dot(relative(system, r, [&](size_t k) { return system.island.velocity[k]; }));
    if (speed < -members.of(contact.a).located_speed &&
        (members.locates_hits || gap_end > -shallow * thickness_of(members, contact)))
      return false;  // hit in the next substep
    stop(members, free, r, contact.gap_start, free.h, system, hits);
    return true;
  };
  const auto n = static_cast<int>(std::erase_if(system.waiting, closes));
  hits.moved.clear();
  return n;
}

}  // namespace talus
