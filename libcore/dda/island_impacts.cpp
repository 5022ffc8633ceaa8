#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "dda/advance_island.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double hit_stiffness = 30;          // D of a hit over the mass that it feels
constexpr double hit_at_start = 1e-6;         // of the substep: a lone block's hit is at its start
constexpr double hit_at_end = 1 - 1e-6;       // ... or at its end
constexpr int most_lone_hits = 100;           // of a block in a step, before they come together
constexpr double hit_share = 0.7;             // first guess of its impulse, of that of a lone hit
constexpr double hit_tolerance = 1e-2;        // of its rebound, of the speed that it came with
constexpr double small_hit_tolerance = 1e-9;  // the same in an island that is factored
constexpr int most_hit_rounds = 8;            // solutions until all hits are found and rebound
constexpr double island_tolerance = 1e-2;     // of contact forces, of what gravity does in the step
constexpr double motion_tolerance = 1e-3;  // ... but not above this part of the fastest speed ...
constexpr double rest_tolerance = 1e-6;    // ... nor below this, of what gravity does
constexpr double small_tolerance = 1e-8;   // the same in an island that is factored
constexpr double linear_tolerance = 3e-2;  // of conjugate gradients in a Newton step

// When a gap of `g` > 0 that closes at `v` and is `gap_end` <= 0 after `h` is zero, its speed taken
// as linear.
double time_of_hit(double g, double v, double gap_end, double h) {
  const double a = 2 * (gap_end - g - v * h) / (h * h);
  return std::min(h, 2 * g / (std::sqrt(std::max(0.0, v * v - 2 * a * g)) - v));
}

}  // namespace

// The contacts of a substep are those at its end. Where a member's corner crosses to a plane that
// it hits, what bore it until then is none of them: it goes on up to the hit. Without that the
// member falls, and the new plane takes up what the old one should have borne, as if all bends came
// half a step too soon. It ends where it would begin to drive the member.
void AdvanceIsland::bear_until_hit(double h) {
  w.support.assign(w.members.size(), {});
  for (IndexSet* members : {&w.hit_members, &w.opened, &w.moved}) members->reset(w.members.size());
  for (const size_t r : w.waiting) {
    const IslandContact& contact = w.contacts[r];
    if (contact.b >= 0 || contact.gap_free > contact.touch) continue;
    double time = 0;
    if (contact.gap_start > 0)
      time = time_of_hit(contact.gap_start, contact.speed_start, contact.gap_free, h);
    const size_t k = place(contact.a);
    if (!w.hit_members.contains(static_cast<int>(k))) w.support[k].until = h;
    w.support[k].until = std::min(w.support[k].until, time);
    w.hit_members.add(static_cast<int>(k));
  }
  for (const int k : w.hit_members.items) set_support_of(static_cast<size_t>(k));
}

// Bears member k by the contacts that it lost.
void AdvanceIsland::set_support_of(size_t k) {
  Support& support = w.support[k];
  const LostContacts& lost = w.lost[k];
  if (support.until == 0 || lost.force == 0) return;
  w.island.free_velocity[k] -= support.until * support.acceleration;
  const Vec3 per_force = state.support[block(k)] / lost.all;
  support.acceleration << lost.force * per_force,
      w.turns[k].per_inertia * lost.arm.cross(w.numbers[k].mass * per_force);
  support.until = std::min(support.until, time_until_it_drives(k));
  w.island.free_velocity[k] += support.until * support.acceleration;
}

// Contacts with the ground that a hit opens pressed until then. True when there are any.
bool AdvanceIsland::bear_by_opened() {
  for (const int member : w.hit_members.items) {
    const auto k = static_cast<size_t>(member);
    if (w.support[k].until == 0 || w.ground_pair[k] < 0) continue;
    for (const size_t r : contacts_of(static_cast<size_t>(w.ground_pair[k]))) {
      const IslandContact& contact = w.contacts[r];
      if (contact.bore <= 0 || row(r).state() != ContactState::open) continue;
      w.lost[k].add(contact.bore, contact.arm);
      w.opened.add(member);
      note_change(r);  // the free motion of its body
    }
  }
  for (const int k : w.opened.items) set_support_of(static_cast<size_t>(k));
  return !w.opened.items.empty();
}

// Power of what bears member k at the start of the substep, and how fast it rises [W, W/s].
std::pair<double, double> AdvanceIsland::support_power(size_t k) const {
  const Vec6& acceleration = w.support[k].acceleration;
  Vec6 velocity, change = acceleration;
  velocity << w.substeps[k].start.velocity, w.turns[k].spin_start;
  change.head<3>() += w.substeps[k].free_acceleration;
  const Vec6 force = w.island.mass[k] * acceleration;
  return {force.dot(velocity), force.dot(change)};
}

// Until when what bears member k takes energy from it.
double AdvanceIsland::time_until_it_drives(size_t k) const {
  const auto [power, rise] = support_power(k);
  if (power > 0) return 0;
  return rise > 0 ? -power / rise : std::numeric_limits<double>::infinity();
}

// Makes contact `r`, which waits, a hit: from its gaps at both ends of the step without it, and its
// speed at the end. Between them the speed is taken as linear; a block that another hit threw goes
// on as fast as it was thrown, so that the speed at the end bounds what this hit can return.
void AdvanceIsland::make_hit(size_t r, double gap_end, double speed_end, double h) {
  IslandContact& contact = w.contacts[r];
  const RowIn<RowGroup> of = row(r);
  const Vec3 normal = of.normal();
  note_hit_pair(static_cast<size_t>(contact.pair));
  contact.waits = false;
  contact.hit = static_cast<int>(w.hits.size());
  Hit& hit = w.hits.emplace_back();
  hit.contact = r;
  const double v = contact.speed_start, g = contact.gap_start;
  const double supported = normal.dot(relative(r, [&](size_t k) { return borne_path(k, h); }));
  const double a = 2 * (gap_end - supported - g - v * h) / (h * h);
  const double a_free = 2 * (contact.gap_free - g - v * h) / (h * h);
  if (g > 0) hit.time = time_of_hit(g, v, gap_end, h);
  if (is_lone() && hit.time > hit_at_end * h) hit.time = h;
  const double rest = h - hit.time, resting_speed = numbers(contact.a).resting_speed;
  const double borne = normal.dot(relative(r, [&](size_t k) -> Vec6 {
    return std::min(hit.time, w.support[k].until) * w.support[k].acceleration;
  }));
  const double speed = std::max(g > 0 ? v + a * hit.time + borne : contact.approach, speed_end);
  const double returned = speed < -resting_speed ? -contact.restitution * speed : 0;
  hit.speed = std::min(speed, -resting_speed);
  hit.rebound = returned;
  hit.fall = std::min(0.0, a_free) * rest;
  hit.target = std::max(0.0, returned + hit.fall);
  const size_t ka = place(contact.a);
  Mobility W = mobility_at(ka, contact.arm, normal);
  if (contact.b >= 0) {
    const size_t kb = place(contact.b);
    const Vec3 arm_b = contact.arm + w.island.position[ka] - w.island.position[kb];
    const Mobility Wb = mobility_at(kb, arm_b, normal);
    W.normal += Wb.normal;
    W.tangent += Wb.tangent;
  }
  // no slip_start: friction against the end velocity never gains energy
  of.set(&RowGroup::normal_damping, hit_stiffness / W.normal);
  of.set(&RowGroup::shear_damping, hit_stiffness / W.tangent);
  const double change_alone = std::max(0.0, hit.target - (v + a_free * h));
  of.set_state(ContactState::slip);
  of.set_vector(&RowGroup::impulse, change_alone / W.normal * hit_share * normal);
  of.set(&RowGroup::bias, -hit.target - change_alone / hit_stiffness);
  note_change(r);
}

// Hits that the free motion leads to: their speed as the solver sees it, with its lever arms and
// what pulls on the bodies until the end of the substep. Gaps over the substep tell it too, but for
// what turning adds; a rebound from one that comes out as the other loses energy, or gains some.
void AdvanceIsland::see_speeds(double h) {
  for (Hit& hit : w.hits) {
    if (!hit.is_free) continue;
    const IslandContact& contact = w.contacts[hit.contact];
    const Vec3 normal = row(hit.contact).normal();
    Vec3 pull = w.substeps[place(contact.a)].free_acceleration;
    if (contact.b >= 0) pull -= w.substeps[place(contact.b)].free_acceleration;
    const Vec3 free =
        relative(hit.contact, [&](size_t k) -> const Vec6& { return w.island.free_velocity[k]; });
    hit.fall = normal.dot(pull) * (h - hit.time);
    const double speed = normal.dot(free) - hit.fall;
    const double resting_speed = numbers(contact.a).resting_speed;
    hit.speed = std::min(speed, -resting_speed);
    hit.rebound = speed < -resting_speed ? -contact.restitution * speed : 0;
    hit.target = std::max(0.0, hit.rebound + hit.fall);
  }
}

// `pair` has a hit, perhaps its first.
void AdvanceIsland::note_hit_pair(size_t pair) {
  for (const size_t r : contacts_of(pair))
    if (w.contacts[r].hit >= 0) return;
  w.hit_pairs.push_back(pair);
}

// Contacts that wait and are hit, by the free motion or by that with the impulses found so far:
// how many.
int AdvanceIsland::find_hits(double h, bool free) {
  const auto moved = [&](int b) { return b >= 0 && w.moved.contains(static_cast<int>(place(b))); };
  const auto is_hit = [&](size_t r) {
    const IslandContact& contact = w.contacts[r];
    if (!free && !moved(contact.a) && !moved(contact.b)) return false;
    const Vec3 normal = row(r).normal();
    double gap_end = contact.gap_free, speed_end = -std::numeric_limits<double>::infinity();
    if (free) {
      gap_end += normal.dot(relative(r, [&](size_t k) { return borne_path(k, h); }));
    } else {
      gap_end += normal.dot(relative(r, [&](size_t k) { return displacement_by_contact(k, h); }));
      speed_end = normal.dot(relative(r, [&](size_t k) { return w.island.velocity[k]; }));
    }
    if (gap_end > contact.touch) return false;
    make_hit(r, gap_end, speed_end, h);
    w.hits.back().is_free = free;
    return true;
  };
  const auto n = static_cast<int>(std::erase_if(w.waiting, is_hit));
  w.moved.clear();
  return n;
}

// The part of the last change of the impulses expected of the hits that was too much, negative: by
// which it was too little. Each round leaves about the same share of the error, so that two of them
// show where it goes (Anderson's acceleration over one round). 0 while the hits are not those of
// the round before.
double AdvanceIsland::overshoot_of_hits() const {
  const auto same = [](const ExpectedHit& a, const ExpectedHit& b) { return a.hit == b.hit; };
  if (!std::ranges::equal(w.expected, w.last_expected, same)) return 0;
  double along = 0, length_sq = 0;
  for (size_t i = 0; i < w.expected.size(); ++i) {
    const double per_damping = 1 / row(w.hits[w.expected[i].hit].contact).normal_damping();
    const double difference = w.expected[i].error - w.last_expected[i].error;
    along += per_damping * w.expected[i].error * difference;
    length_sq += per_damping * difference * difference;
  }
  return length_sq > 0 ? std::clamp(along / length_sq, -1.0, 0.5) : 0;
}

// Moves the targets of the hits by what finite stiffness left: the largest error, of the speed.
double AdvanceIsland::correct_hits() {
  double worst = 0;
  w.expected.swap(w.last_expected);
  w.expected.clear();
  for (size_t i = 0; i < w.hits.size(); ++i) {
    const Hit& hit = w.hits[i];
    const RowIn<RowGroup> of = row(hit.contact);
    const double p_n = of.normal_impulse();
    if (p_n <= 0) continue;
    const double expected = -of.normal_damping() * (of.bias() + hit.target);
    w.expected.push_back({i, p_n, p_n - expected});
    worst = std::max(worst, std::abs(p_n - expected) / of.normal_damping() / -hit.speed);
  }
  const double overshoot = overshoot_of_hits();
  for (size_t i = 0; i < w.expected.size(); ++i) {
    const Hit& hit = w.hits[w.expected[i].hit];
    const RowIn<RowGroup> of = row(hit.contact);
    double expected = w.expected[i].impulse;
    if (overshoot != 0)
      expected = std::max(0.0, expected - overshoot * (expected - w.last_expected[i].impulse));
    of.set(&RowGroup::bias, -hit.target - expected / of.normal_damping());
    note_change(hit.contact);
  }
  return worst;
}

double AdvanceIsland::fastest() const {
  double speed = 0;
  for (size_t k = 0; k < w.members.size(); ++k)
    speed = std::max(speed, w.substeps[k].start.velocity.norm());
  return speed;
}

// Speed of the fastest hit.
double AdvanceIsland::fastest_hit() const {
  double fastest = 0;
  for (const Hit& hit : w.hits) fastest = std::max(fastest, -hit.speed);
  return fastest;
}

bool AdvanceIsland::solve_once(double h, bool continues) {
  IslandSettings settings;
  settings.continues = continues;
  const double by_gravity = scene.gravity.norm() * h;
  settings.tolerance = small_tolerance * by_gravity;
  settings.direct_bodies = small ? static_cast<int>(w.members.size()) : 0;
  if (!small) {
    const double by_motion = std::clamp(motion_tolerance * fastest(), rest_tolerance * by_gravity,
                                        island_tolerance * by_gravity);
    settings.tolerance = std::max(by_motion, hit_tolerance * fastest_hit());
    settings.linear_tolerance = linear_tolerance;
  }
  settings.tolerance *= scene.settings.tolerance_factor;
  const IslandResult solved = solve_island(w.island, settings, w.solver);
  report.passes += solved.passes;
  for (const int k : w.solver.touched_bodies.items) w.moved.add(k);
  return solved.converged;
}

// Where the substep of a lone block has to end, since it is hit on the way; h + 1: nowhere.
double AdvanceIsland::first_hit(double h) const {
  double first = h + 1;
  if (!is_lone() || lone_hits >= most_lone_hits) return first;
  for (const Hit& hit : w.hits)
    if (hit.time > hit_at_start * h && hit.time < h) first = std::min(first, hit.time);
  return first;
}

// Impulses of the substep, hits included; gives up where first_hit() says that it ends sooner.
bool AdvanceIsland::solve(double h) {
  bear_until_hit(h);
  n_hits = find_hits(h, true);
  if (first_hit(h) < h) return true;
  w.expected.clear();
  w.time.assign(w.members.size(), h / 2);
  set_times(h, true);
  const double tolerance = small ? small_hit_tolerance : hit_tolerance;
  bool converged = solve_once(h, false);
  for (int round = 0; round < most_hit_rounds && converged; ++round) {
    if (round == 0 && bear_by_opened()) {
      converged = solve_once(h, true);
      if (!converged) break;
    }
    const int more = find_hits(h, false);
    n_hits += more;
    if (n_hits == 0 || first_hit(h) < h) return true;
    set_targets(h);
    const double error = correct_hits();
    if (more > 0) set_times(h, false);
    if (more == 0 && error <= tolerance) break;
    converged = solve_once(h, true);
  }
  if (converged && work_on_velocities() > -loss_in_turn()) converged = lower_rebound(h, tolerance);
  return converged;
}

bool AdvanceIsland::is_closed() const {
  return std::none_of(w.island.pairs.begin(), w.island.pairs.end(),
                      [](const BodyPair& pair) { return pair.b < 0; });
}

// When each member's velocity changes, on the mean over the expected impulses: a contact that
// presses all along acts in the middle of the substep, a hit at its time. Lever arms count from
// where the members are then, so that angular momentum is kept. An island that touches nothing
// else takes one time for all its impulses: different ones would move its centre of mass.
void AdvanceIsland::set_times(double h, bool first) {
  w.last_time = w.time;
  if (!w.hits.empty()) find_mean_times(h);
  bool any = false;
  w.shifted.assign(w.members.size(), 0);
  for (size_t k = 0; k < w.members.size(); ++k) {
    w.shifted[k] = w.time[k] != w.last_time[k] || w.opened.contains(static_cast<int>(k));
    any |= w.shifted[k] != 0;
    if (!first && w.shifted[k] == 0) continue;
    w.island.position[k] = w.substeps[k].free.pose.position -
                           (h - w.time[k]) * w.substeps[k].free.velocity +
                           borne_path(k, w.time[k]).head<3>();
  }
  if (any) shift_arms(h);
}

// Times of the members that are hit; of the others they stay as they are.
void AdvanceIsland::find_mean_times(double h) {
  const bool closed = is_closed();
  w.is_timed.assign(w.members.size(), closed);
  w.weight.assign(w.members.size(), 0);
  w.delay.assign(w.members.size(), 0);
  for (const Hit& hit : w.hits) {
    const double delay = row(hit.contact).impulse().norm() * (hit.time - h / 2);
    for (const int b : {w.contacts[hit.contact].a, w.contacts[hit.contact].b}) {
      if (b < 0) continue;
      w.is_timed[place(b)] = 1;
      w.delay[place(b)] += delay;
    }
  }
  const auto is_timed = [&](int k) { return k >= 0 && w.is_timed[static_cast<size_t>(k)] != 0; };
  for (const BodyPair& pair : w.island.pairs) {
    if (!is_timed(pair.a) && !is_timed(pair.b)) continue;
    for (int r = pair.row_begin; r < pair.row_end; ++r) {
      const double p = row_of(w.island, r).impulse().norm();
      w.weight[static_cast<size_t>(pair.a)] += p;
      if (pair.b >= 0) w.weight[static_cast<size_t>(pair.b)] += p;
    }
  }
  if (closed) {
    const double weight = std::accumulate(w.weight.begin(), w.weight.end(), 0.0);
    const double delay = std::accumulate(w.delay.begin(), w.delay.end(), 0.0);
    std::fill(w.weight.begin(), w.weight.end(), weight);
    std::fill(w.delay.begin(), w.delay.end(), delay);
  }
  for (size_t k = 0; k < w.members.size(); ++k)
    if (w.is_timed[k] != 0) w.time[k] = w.weight[k] > 0 ? h / 2 + w.delay[k] / w.weight[k] : h / 2;
}

// Lever arms between blocks of which one is shifted.
void AdvanceIsland::shift_arms(double h) {
  for (size_t p = 0; p < w.island.pairs.size(); ++p) {
    BodyPair& pair = w.island.pairs[p];
    if (pair.b < 0) continue;
    const auto ka = static_cast<size_t>(pair.a), kb = static_cast<size_t>(pair.b);
    if (w.shifted[ka] == 0 && w.shifted[kb] == 0) continue;
    pair.changed = true;
    const Vec3 shift = ((w.time[kb] - h / 2) * w.substeps[kb].free.velocity -
                        (w.time[ka] - h / 2) * w.substeps[ka].free.velocity) /
                       2;
    for (const size_t r : contacts_of(p))
      row(r).set_vector(&RowGroup::arm, w.contacts[r].arm + shift);
  }
}

void AdvanceIsland::set_displacements(double h) {
  w.displacement.resize(w.members.size());
  for (size_t k = 0; k < w.members.size(); ++k) {
    w.displacement[k] = displacement_by_contact(k, h);
  }
}

}  // namespace talus
