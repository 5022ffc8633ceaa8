// Looks at pairs of an island: when they may be hit, and which contacts touch then.
#include "step/island/impact_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/scales.hpp"
#include "motion/rotation.hpp"
#include "scene/fence.hpp"
#include "solver/law_numbers.hpp"
#include "step/flight.hpp"
#include "step/soil.hpp"
#include "step/substep.hpp"

namespace talus {
namespace {

using std::size_t;

using law::after_hit, law::most_looks_for_time, law::support_drives;

// When a gap of `g` > 0 that closes at `v` and is `gap_end` after `h` is zero, its speed taken as
// linear.
double time_to_close(double g, double v, double gap_end, double h) {
  const double a = 2 * (gap_end - g - v * h) / (h * h);
  return std::min(h, 2 * g / (std::sqrt(std::max(0.0, v * v - 2 * a * g)) - v));
}

Vec3 point_of(const PlacedMotion& m, const Vec3& arm) { return m.position + arm; }
Vec3 velocity_of(const PlacedMotion& m, const Vec3& arm) { return m.velocity + m.spin.cross(arm); }

bool carries(const State& state, int b) {
  const std::vector<ContactMemory>& memory = state.memory[b];
  return std::any_of(memory.begin(), memory.end(),
                     [](const ContactMemory& m) { return m.normal_force > 0; });
}

// The support of member k continues until its first hit, or until it would begin to drive it.
void set_support_in_flight(const State& state, const IslandMembers& members, const Substep& s,
                           size_t k, FlyingMember& flying) {
  const BlockNumbers& c = members.numbers[k];
  flying.support = state.support[members.block(k)];
  if (flying.support.isZero(0)) return;
  const double power = flying.support.dot(s.start.velocity),
               rise = flying.support.dot(flying.support + s.free_acceleration),
               most = support_drives * c.gravity * c.resting_speed;
  flying.support_until = s.h;
  if (power > most)
    flying.support_until = 0;
  else if (rise > 0)
    flying.support_until = std::min(s.h, (most - power) / rise);
}

}  // namespace

RowMotion row_motion(const FreeMotions& free, const IslandSystem& system, size_t r,
                     const PlacedMotion& a, const PlacedMotion* b) {
  const KeptContact& contact = system.contacts[r];
  const BodyPair& pair = system.island.pairs[contact.pair];
  const Vec3 normal = row_of(system, r).normal();
  const Vec3& start_a = free.substeps[pair.a].start.pose.position;
  const Vec3 arm_a = a.turn * contact.arm_start;
  RowMotion out;
  out.point_a = point_of(a, arm_a);
  out.velocity = velocity_of(a, arm_a);
  Vec3 moved = out.point_a - start_a - contact.arm_start;
  out.point_b = start_a + contact.arm_start - contact.gap_start * normal;
  if (b != nullptr) {
    const Vec3& start_b = free.substeps[pair.b].start.pose.position;
    const Vec3 arm_start = out.point_b - start_b, arm_b = b->turn * arm_start;
    moved -= point_of(*b, arm_b) - out.point_b;
    out.point_b = point_of(*b, arm_b);
    out.velocity -= velocity_of(*b, arm_b);
  }
  out.gap = contact.gap_start + normal.dot(moved);
  out.speed = normal.dot(out.velocity);
  return out;
}

void ImpactSearch::begin() const {
  const Hulls& hulls = scene.blocks.hulls;
  if (hits.placed.turned.size() != hulls.radius.size())
    place_hulls(hulls, search.poses, {}, {}, hits.placed);
  const size_t n = members.size();
  hits.members.assign(n, {});
  for (size_t k = 0; k < n; ++k) {
    const Substep& s = free.substeps[k];
    hits.members[k].motion = s.start;
    if (!scene.loads.empty())
      hits.members[k].torque = (s.free.angular_momentum - s.start.angular_momentum) / s.h;
    if (!members.numbers[k].stands &&
        (carries(state, members.blocks[k]) || system.ground_pair[k] >= 0))
      set_support_in_flight(state, members, s, k, hits.members[k]);
  }
  const size_t n_pairs = system.island.pairs.size();
  hits.n_looks.assign(n_pairs, 0);
  hits.n_pair_hits.assign(n_pairs, 0);
  hits.is_closed.assign(n_pairs, 0);
  hits.queue.clear();
  hits.pair_begin.assign(n + 1, 0);
  for (const BodyPair& pair : system.island.pairs)
    for (const int k : {pair.a, pair.b})
      if (k >= 0) ++hits.pair_begin[k];
  int sum = 0;
  for (int& begin : hits.pair_begin) begin = sum += begin;
  hits.pairs.resize(static_cast<size_t>(sum));
  for (size_t p = n_pairs; p-- > 0;)
    for (const int k : {system.island.pairs[p].a, system.island.pairs[p].b})
      if (k >= 0) hits.pairs[--hits.pair_begin[k]] = static_cast<int>(p);
}

Motion ImpactSearch::motion_of(size_t k, double time) const {
  const FlyingMember& flying = hits.members[k];
  const Substep& s = free.substeps[k];
  const double dt = time - flying.clock;
  if (dt <= 0) return flying.motion;
  Motion m = fly(flying.motion, members.numbers[k].inertia, s.free_acceleration, dt);
  m.angular_momentum += dt * flying.torque;
  if (flying.was_hit || flying.support_until == 0) return m;
  const double supported = std::min(dt, flying.support_until);
  m.velocity += supported * flying.support;
  m.pose.position += supported * (dt - supported / 2) * flying.support;
  return m;
}

PlacedMotion ImpactSearch::place(size_t k, const Motion& motion) const {
  const Mat3 R = motion.pose.attitude.toRotationMatrix();
  const Vec3 in_body = R.transpose() * motion.angular_momentum;
  return {motion.pose.position, R * free.substeps[k].R_start.transpose(), motion.velocity,
          R * in_body.cwiseProduct(members.numbers[k].inverse_inertia)};
}

const MemberMotion& ImpactSearch::member_at(size_t k, double time) const {
  FlyingMember& flying = hits.members[k];
  if (flying.now_version != flying.version || flying.now_time != time) {
    flying.now.motion = motion_of(k, time);
    flying.now.placed = place(k, flying.now.motion);
    flying.now_version = flying.version;
    flying.now_time = time;
  }
  return flying.now;
}

const PlacedMotion& ImpactSearch::end_of_member(size_t k) const {
  FlyingMember& flying = hits.members[k];
  if (flying.end_version != flying.version) {
    flying.end = place(k, motion_of(k, free.h));
    flying.end_version = flying.version;
  }
  return flying.end;
}

int ImpactSearch::version_of(size_t p) const {
  const BodyPair& pair = system.island.pairs[p];
  const int of_b = pair.b < 0 ? 0 : hits.members[pair.b].version;
  return hits.members[pair.a].version + of_b;
}

void ImpactSearch::push(const ImpactCandidate& look) const {
  hits.queue.push_back(look);
  std::push_heap(hits.queue.begin(), hits.queue.end(), comes_after);
}

double ImpactSearch::size_of(size_t p) const {
  const BodyPair& pair = system.island.pairs[p];
  const double a = members.numbers[pair.a].radius;
  return pair.b < 0 ? a : std::min(a, members.numbers[pair.b].radius);
}

// Approach above which a pair is hit at `time`: a contact that touches when the substep begins, and
// closed slowly in the one before, is located; later ones end this substep.
double ImpactSearch::hit_speed(size_t k, double time) const {
  const BlockNumbers& c = members.numbers[k];
  return time == 0 ? c.located_speed : c.resting_speed;
}

// Whether something presses member k until its first hit: then it is not in free flight.
bool ImpactSearch::is_pressed(size_t k) const {
  const FlyingMember& flying = hits.members[k];
  return !flying.was_hit && !flying.support.isZero(0);
}

void ImpactSearch::look_ahead(size_t p, double from, double not_before) const {
  if (hits.is_closed[p] != 0) return;
  if (++hits.n_looks[p] > 2 * law::most_hits) {
    hits.is_closed[p] = 1;
    return;
  }
  const BodyPair& pair = system.island.pairs[p];
  const auto ka = static_cast<size_t>(pair.a), kb = static_cast<size_t>(std::max(pair.b, 0));
  const double h = free.h, rest = h - from;
  if (!(rest > 0)) return;
  const PlacedMotion& a = member_at(ka, from).placed;
  const PlacedMotion* b = pair.b < 0 ? nullptr : &member_at(kb, from).placed;
  const PlacedMotion& end_a = end_of_member(ka);
  const PlacedMotion* end_b = pair.b < 0 ? nullptr : &end_of_member(kb);
  const double resting = members.numbers[ka].resting_speed, open = negligible * size_of(p);
  ImpactCandidate look;
  look.time = h + 1;
  for (const size_t r : contacts_of(system, p)) {
    const KeptContact& contact = system.contacts[r];
    if (contact.bond_area != 0 || row_of(system, r).normal_limit() < no_normal_limit) continue;
    const RowMotion now = row_motion(free, system, r, a, b);
    const RowMotion then = row_motion(free, system, r, end_a, end_b);
    ImpactCandidate of_row;
    of_row.time = h + 1;
    of_row.speed = std::max(-now.speed, -then.speed);
    if (now.gap <= open) {
      if (now.speed < -hit_speed(ka, from)) {
        of_row.time = from;
      } else if (then.speed < -resting && then.gap <= open) {
        const double change = now.speed - then.speed;
        of_row.time = from + rest * std::max((now.speed + resting) / change,
                                             std::min(1.0, 2 * now.speed / change));
      }
    } else if (then.gap <= contact.touch && of_row.speed > resting) {
      of_row.time = from + time_to_close(now.gap, now.speed, then.gap, rest);
      of_row.from = from;
      of_row.gap = now.gap;
    }
    if (of_row.time < look.time) look = of_row;
  }
  if (look.time > h) return;
  if (look.time < not_before) {
    look.time = not_before;
    look.gap = 0;
  }
  if (look.time >= h) return;
  if (look.time > 0 && members.locates_hits && (is_pressed(ka) || (pair.b >= 0 && is_pressed(kb))))
    return;  // ends the substep, with all that presses
  look.pair = static_cast<int>(p);
  look.version = version_of(p);
  push(look);
}

void ImpactSearch::take_due(std::vector<ImpactCandidate>& due) const {
  due.clear();
  const auto pop = [&] {
    std::pop_heap(hits.queue.begin(), hits.queue.end(), comes_after);
    const ImpactCandidate look = hits.queue.back();
    hits.queue.pop_back();
    return look;
  };
  while (!hits.queue.empty()) {
    const ImpactCandidate& next = hits.queue.front();
    const auto p = static_cast<size_t>(next.pair);
    if (next.version != version_of(p) || hits.is_closed[p] != 0) {
      (void)pop();
      continue;
    }
    if (!due.empty()) {
      const double after = next.time - due.front().time;
      if (after > rounding * free.h && after * next.speed > negligible * size_of(p)) return;
    }
    ImpactCandidate look = pop();
    if (!due.empty()) look.time = due.front().time;
    due.push_back(look);
  }
}

namespace {

// Speed across the normal of a contact's point on bodies that move so; null: at rest [m/s].
double slip_of(const ImpactContact& contact, const PlacedMotion& a, const PlacedMotion* b) {
  Vec3 u = velocity_of(a, contact.point - a.position);
  if (b != nullptr) u -= velocity_of(*b, contact.point - b->position);
  return (u - contact.normal.dot(u) * contact.normal).norm();
}

}  // namespace

ImpactContact& ImpactSearch::add_touching(size_t p, const Vec3& normal, const Vec3& point,
                                          double gap, const ContactKey& key,
                                          const GroundClass& faces) const {
  const BodyPair& pair = system.island.pairs[p];
  ImpactContact touching;
  touching.a = pair.a;
  touching.b = pair.b;
  touching.normal = normal;
  touching.point = point;
  touching.friction = faces.friction;
  touching.restitution = faces.restitution;
  touching.resting_speed = members.numbers[static_cast<size_t>(pair.a)].resting_speed;
  touching.key = key;
  touching.gap = gap;
  touching.pair = static_cast<int>(p);
  hits.touching.push_back(touching);
  return hits.touching.back();
}

void ImpactSearch::find_touching_ground(size_t p, double time) const {
  const auto k = static_cast<size_t>(system.island.pairs[p].a);
  const BlockNumbers& c = members.numbers[k];
  const Motion& m = member_at(k, time).motion;
  const double margin = 1e-2 * c.radius;
  (void)find_contacts(scene.ground, scene.blocks.shapes, members.blocks[k], m.pose,
                      Mat3::Identity(), margin, making.world_vertices, making.found,
                      &near_ground[members.block(k)]);
  for (const Contact& found : making.found) {
    const GroundClass& ground = scene.ground.classes[found.ground_class];
    ImpactContact& touching = add_touching(
        p, found.normal, talus::place(m.pose, found.point_a) - found.gap / 2 * found.normal,
        found.gap, found.key, ground);
    const int b = members.blocks[k];
    touching.fall = fall_on(ground, c.mass);
    touching.arm = arm_on(scene, ground, b);
    touching.dent = dent_on(scene, ground, b);
    vary_friction(ground, slide_of(state, b, free.t + time),
                  slip_of(touching, place(k, m), nullptr), 0, touching.friction);
  }
}

void ImpactSearch::find_touching_bodies(size_t p, double time) const {
  const BodyPair& pair = system.island.pairs[p];
  const PairManifold& of = search.pairs.manifolds[system.pair_manifold[p]];
  const Hulls& hulls = scene.blocks.hulls;
  const auto ka = static_cast<size_t>(pair.a);
  place_body(hulls, of.block_a, member_at(ka, time).motion.pose, hits.placed);
  place_body(hulls, of.block_b,
             pair.b < 0 ? search.poses[of.block_b]
                        : member_at(static_cast<size_t>(pair.b), time).motion.pose,
             hits.placed);
  hits.held.clear();
  hits.manifolds.clear();
  hits.points.clear();
  const double margin = 1e-2 * size_of(p);
  const ContactSearch found = search_contact(hulls, hits.placed, of.part_a, of.part_b, margin, {},
                                             false, hits.axis, hits.clip, hits.held);
  if (!found.choice.touches || found.choice.axis.kind == AxisKind::none) return;
  add_manifold(hulls, hits.placed, of.part_a, of.part_b, found.choice.axis, found.incident,
               axis_normal(hulls, hits.placed, of.part_a, of.part_b, found.choice.axis), found.area,
               PointReach{margin}, hits.held, hits.manifolds, hits.points);
  if (hits.manifolds.empty()) return;
  const PairManifold& m = hits.manifolds.front();
  if (pair.b < 0 && giving_way(scene, fixed_of(scene, of.block_b), m.normal) != nullptr) return;
  const GroundClass faces =
      pair.b < 0 ? fixed_class(scene, fixed_of(scene, of.block_b)) : pair_class(scene, m);
  for (int i = m.point_begin; i < m.point_end; ++i) {
    const PairPoint& point = hits.points[i];
    ImpactContact& touching = add_touching(p, m.normal, point.point_b + point.gap / 2 * m.normal,
                                           point.gap, point.key, faces);
    const PlacedMotion* b =
        pair.b < 0 ? nullptr : &member_at(static_cast<size_t>(pair.b), time).placed;
    weaken_friction(faces, slip_of(touching, member_at(ka, time).placed, b), touching.friction);
  }
}

void ImpactSearch::find_touching(size_t p, double time) const {
  hits.touching.clear();
  if (system.pair_manifold[p] < 0)
    find_touching_ground(p, time);
  else
    find_touching_bodies(p, time);
}

void ImpactSearch::look_at(const ImpactCandidate& look) const {
  const auto p = static_cast<size_t>(look.pair);
  const BodyPair& pair = system.island.pairs[p];
  const double h = free.h, open = negligible * size_of(p);
  const auto schedule = [&] { look_ahead(p, look.time, look.time + after_hit * h); };
  find_touching(p, look.time);
  if (hits.touching.empty()) return schedule();
  const auto ka = static_cast<size_t>(pair.a);
  const PlacedMotion& a = member_at(ka, look.time).placed;
  const PlacedMotion* b =
      pair.b < 0 ? nullptr : &member_at(static_cast<size_t>(pair.b), look.time).placed;
  // contacts fast enough to be hit: one that was hit already, or slides, does not give the time
  constexpr double none = std::numeric_limits<double>::infinity();
  const double resting = hit_speed(ka, look.time);
  double least = none, approach_of_least = 0;
  for (ImpactContact& c : hits.touching) {
    Vec3 u = velocity_of(a, c.point - a.position);
    if (b != nullptr) u -= velocity_of(*b, c.point - b->position);
    c.approach = c.normal.dot(u);
    if (c.approach < -resting && c.gap <= least) least = c.gap, approach_of_least = c.approach;
  }
  if (least == none) return schedule();
  ImpactCandidate again = look;
  ++again.tries;
  if (again.tries <= most_looks_for_time) {
    if (least > open) {  // not yet
      again.from = look.time;
      again.gap = least;
      again.time = look.time - least / approach_of_least;
      if (again.time < h) push(again);
      return;
    }
    if (least < -open && look.gap > open) {  // it was hit before
      again.time = look.time - least / approach_of_least;
      if (again.time <= look.from)
        again.time = look.from + (look.time - look.from) * look.gap / (look.gap - least);
      if (again.time < look.time) return push(again);
    }
  } else if (least > open) {
    return schedule();
  }
  double fastest = 0;
  const double below = std::max(least, 0.0) + open;
  for (const ImpactContact& touching : hits.touching)
    if (touching.gap <= below) fastest = std::max(fastest, -touching.approach);
  for (const ImpactContact& touching : hits.touching)
    if (touching.gap <= below && touching.approach <= rounding * fastest)
      hits.batch.push_back(touching);
}

}  // namespace talus
